// SPDX-License-Identifier: GPL-3.0-or-later
// glb: binary glTF 2.0 (Khronos): one mesh of positions, normals and the attributes _VELOCITY and _BODY, with the material of water (KHR_materials_transmission,
// KHR_materials_ior). A node turns z, which is up in a case, to y, which is up in glTF, and has the place of the mesh's centre, about which its numbers are.

#include "MovingFormat.H"

#include "core/fieldFile/AtomicFile.H"

#include <algorithm>
#include <cstdint>
#include <sstream>
#include <string>

namespace shizuku
{

namespace
{

using Word = std::uint32_t;

void appendWord(std::string& bytes, Word word) { bytes.append(reinterpret_cast<const char*>(&word), sizeof word); }

// As three floats each.
std::string packed(const std::vector<Vector3>& vectors, const Vector3& origin = {})
{
    std::string bytes;
    for (const Vector3& v : vectors)
    {
        for (int c = 0; c < 3; ++c)
        {
            const auto number = float(v[c] - origin[c]);
            bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
        }
    }
    return bytes;
}

struct MeshBox
{
    Vector3 low, high;
    Vector3 centre() const { return 0.5*(low + high); }
};

MeshBox boxOf(const TriangleMesh& mesh)
{
    MeshBox box;
    if (!mesh.vertices.empty()) box.low = box.high = mesh.vertices.front();
    for (const Vector3& v : mesh.vertices)
    {
        for (int c = 0; c < 3; ++c)
        {
            box.low[c] = std::min(box.low[c], v[c]);
            box.high[c] = std::max(box.high[c], v[c]);
        }
    }
    return box;
}

std::string vectorText(const Vector3& v)
{
    std::ostringstream text;
    text.precision(9);
    text << '[' << float(v.x) << ',' << float(v.y) << ',' << float(v.z) << ']';
    return text.str();
}

// A chunk of a GLB: its length, a multiple of 4, its kind and its bytes.
void appendChunk(std::string& bytes, Word kind, std::string content, char fill)
{
    content.resize((content.size() + 3)/4*4, fill);
    appendWord(bytes, Word(content.size()));
    appendWord(bytes, kind);
    bytes += content;
}

constexpr Word magic = 0x46546c67, version = 2, json = 0x4e4f534a, binary = 0x004e4942;     // of the glTF 2.0 specification, chapter 4
constexpr int floats = 5126, words = 5125;                                                  // its component types

}

class MovingGlb : public MovingFormat
{
public:
    void write(const std::filesystem::path& file, const MovingSurface& surface) const override;
};

static const MovingFormatTable::Add<MovingGlb> registeredGlb{"glb"};

void MovingGlb::write(const std::filesystem::path& file, const MovingSurface& surface) const
{
    const TriangleMesh& mesh = surface.mesh;
    const MeshBox box = boxOf(mesh);
    const Vector3 centre = box.centre();
    std::string indices;
    for (const auto& face : mesh.faces)
    {
        for (const int corner : face) appendWord(indices, Word(corner));
    }
    std::string bodies;
    for (const int body : surface.bodies)
    {
        const auto number = float(body);
        bodies.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    const std::string parts[]{packed(mesh.vertices, centre), packed(mesh.normals), packed(surface.velocities), bodies, indices};

    std::ostringstream text;
    text << R"({"asset":{"version":"2.0","generator":"Shizuku exportSurface"},"scene":0,"scenes":[{"nodes":[0]}],"extensionsUsed":["KHR_materials_transmission","KHR_materials_ior"],)"
         << R"("nodes":[{"name":"liquid","mesh":0,"rotation":[-0.707106781,0,0,0.707106781],"translation":)" << vectorText({centre.x, centre.z, -centre.y})
         << R"(,"extras":{"time":)" << surface.time << "}}],"
         << R"("materials":[{"name":"water","pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},)"
         << R"("extensions":{"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":1.333}}}],)"
         << R"("meshes":[{"name":"liquid","primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"_VELOCITY":2,"_BODY":3},"indices":4,"material":0}]}],"accessors":[)";
    for (int a = 0; a < 4; ++a)
    {
        text << R"({"bufferView":)" << a << R"(,"componentType":)" << floats << R"(,"count":)" << mesh.vertices.size() << R"(,"type":")" << (a < 3 ? "VEC3" : "SCALAR") << '"';
        if (a == 0) text << R"(,"min":)" << vectorText(box.low - centre) << R"(,"max":)" << vectorText(box.high - centre);
        text << "},";
    }
    text << R"({"bufferView":4,"componentType":)" << words << R"(,"count":)" << 3*mesh.faces.size() << R"(,"type":"SCALAR"}],"bufferViews":[)";
    std::string all;
    for (const std::string& part : parts)
    {
        text << (all.empty() ? "" : ",") << R"({"buffer":0,"byteOffset":)" << all.size() << R"(,"byteLength":)" << part.size() << '}';
        all += part;
    }
    text << R"(],"buffers":[{"byteLength":)" << all.size() << "}]}";

    std::string chunks;
    appendChunk(chunks, json, text.str(), ' ');
    appendChunk(chunks, binary, all, '\0');
    std::string bytes;
    for (const Word word : {magic, version, Word(chunks.size() + 3*sizeof(Word))}) appendWord(bytes, word);
    bytes += chunks;
    writeAtomically(file, [&](std::ostream& out) { out.write(bytes.data(), std::streamsize(bytes.size())); });
}

}
