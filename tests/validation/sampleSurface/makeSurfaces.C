// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the surfaces of the study, whole ones and broken ones, each in one of the formats that sampleSurface reads:
//
//     makeSurfaces FOLDER
//
// They are made for a particle spacing of 1 mm; lengths in the files are metres, but for millimetres.stl.

#include "meshes/PlyFile.H"
#include "support/Shapes.H"
#include "support/Surfaces.H"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <numbers>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

class Folder
{
public:
    explicit Folder(const std::filesystem::path& path) : path_(path) { std::filesystem::create_directories(path); }

    // By the extension: .stl (`binary` or not), .obj, .ply, .off. The surface is in millimetres.
    void write(const std::string& name, PatchedSurface surface, bool binary = false, double scale = 1e-3) const
    {
        for (Vector3& v : surface.mesh.vertices) v *= scale;
        const auto file = path_/name;
        const std::string extension = file.extension();
        if (extension == ".ply")
        {
            writePly(file, surface.mesh, binary ? PlyFormat::binary : PlyFormat::ascii);
            return;
        }
        std::ofstream out(file, std::ios::binary);
        out.precision(std::numeric_limits<float>::max_digits10);
        if (extension == ".obj") writeObj(out, surface);
        else if (extension == ".off") writeOff(out, surface.mesh);
        else if (binary) writeBinaryStl(out, surface.mesh);
        else out << stlText(surface);
    }

    void text(const std::string& name, const std::string& content) const
    {
        std::ofstream(path_/name, std::ios::binary) << content;
    }

    std::string bytes(const std::string& name) const
    {
        std::ifstream in(path_/name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

private:
    static void writeObj(std::ostream& out, const PatchedSurface& surface)
    {
        for (const Vector3& v : surface.mesh.vertices) out << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
        for (std::size_t p = 0; p < surface.patches.size(); ++p)
        {
            out << "g " << surface.patches[p] << '\n';
            for (std::size_t f = 0; f < surface.mesh.faces.size(); ++f)
            {
                if (surface.patch[f] != int(p)) continue;
                out << 'f';
                for (const int v : surface.mesh.faces[f]) out << ' ' << v + 1;
                out << '\n';
            }
        }
    }

    static void writeOff(std::ostream& out, const TriangleMesh& mesh)
    {
        out << "OFF\n" << mesh.vertices.size() << ' ' << mesh.faces.size() << " 0\n";
        for (const Vector3& v : mesh.vertices) out << v.x << ' ' << v.y << ' ' << v.z << '\n';
        for (const auto& [a, b, c] : mesh.faces) out << "3 " << a << ' ' << b << ' ' << c << '\n';
    }

    static void writeBinaryStl(std::ostream& out, const TriangleMesh& mesh)
    {
        out << std::string(80, ' ');
        const auto put = [&](const auto& value) { out.write(reinterpret_cast<const char*>(&value), sizeof value); };
        put(std::uint32_t(mesh.faces.size()));
        for (const auto& face : mesh.faces)
        {
            for (int c = 0; c < 3; ++c) put(0.0f);
            for (const int v : face) for (int c = 0; c < 3; ++c) put(float(mesh.vertices[v][c]));
            put(std::uint16_t(0));
        }
    }

    std::filesystem::path path_;
};

void writeWhole(const Folder& folder)
{
    folder.write("plane.stl", rectangle(47.3, 31.7));
    folder.write("sphere.stl", sphere(10, 5), true);
    folder.write("torus.ply", torus(12, 4, 96), true);
    folder.write("blob.ply", blob(10, 5));
    folder.write("cylinder.obj", cylinder(8, 20, 90));
    folder.write("cone.off", cone(8, 16, 72));
    folder.write("plate.stl", box({0, 0, 0}, {20, 25, 0.6}), true);
    folder.write("box.obj", box({0, 0, 0}, {12.3, 9.1, 7.7}));
    folder.write("terrain.stl", terrain(30, 10, 80), true);
    folder.write("gear.stl", extrusion("gear", gearOutline(10, 8, 11), 6));
    folder.write("stairs.off", extrusion("stairs", stairsOutline(6, 3, 2), 15));
    folder.write("helix.ply", tube([](double t)
    {
        const double a = 6*std::numbers::pi*t;
        return Vector3(7*std::cos(a), 7*std::sin(a), 18*t);
    }, false, 1.6, 220, 24));
    PatchedSurface text;
    for (const PatchedSurface& letter : letters(12, 3)) text = joined(text, letter);
    folder.write("letters.stl", text);
    folder.write("tank.obj", turnedOver(cylinder(9, 14, 90)));
    folder.write("bowl.off", turnedOver(patchOf("bowl", 72, 24, true, false, [](double u, double v)
    {
        const double a = 2*std::numbers::pi*u, b = 0.02 + 0.5*std::numbers::pi*v;
        return Vector3(10*std::sin(b)*std::cos(a), 10*std::sin(b)*std::sin(a), -10*std::cos(b));
    })));
}

void writeBroken(const Folder& folder)
{
    PatchedSurface scan = withNoise(sphere(10, 5), 0.05);
    for (const Vector3& hole : {Vector3(0, 0, 10), Vector3(10, 0, 0), Vector3(-5, 7, 5), Vector3(0, -10, 1)})
    {
        scan = withHole(scan, hole, 1.2);
    }
    folder.write("scan.stl", withHole(scan, {0, 0, -10}, 4), true);
    folder.write("flipped.stl", withFlippedFaces(torus(12, 4, 96), 0.3), true);
    folder.write("duplicates.stl", withSlivers(withDuplicateFaces(blob(10, 4), 0.2), 0.1));
    folder.write("overlapping.stl", joined(joined(sphere(8, 4), moved(sphere(6, 4), {9, 0, 0})), box({-2, -3, -12}, {3, 2, 12})));
    folder.write("crossing.ply", tube([](double t)
    {
        const double a = 2*std::numbers::pi*t;
        return Vector3(14*std::sin(a), 14*std::sin(a)*std::cos(a), 0.3*std::cos(a));
    }, true, 2.2, 240, 30));
    // Two boxes that share an edge, and a fin that stands on a floor.
    folder.write("nonManifold.off", joined(box({0, 0, 0}, {8, 8, 8}), box({8, 8, 0}, {16, 16, 8})));
    PatchedSurface fin = rectangle(20, 20);
    fin.mesh.vertices = {{0, 0, 0}, {10, 0, 0}, {20, 0, 0}, {0, 20, 0}, {10, 20, 0}, {20, 20, 0}, {10, 0, 9}, {10, 20, 9}};
    fin.mesh.faces = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {1, 4, 7}, {1, 7, 6}};
    fin.patch.assign(6, 0);
    folder.write("fin.stl", fin);
    folder.write("cracked.stl", crackedBox(), true);
    folder.write("millimetres.stl", extrusion("gear", gearOutline(10, 8, 11), 6), true, 1);
}

void writeUnusable(const Folder& folder)
{
    const std::string ascii = folder.bytes("gear.stl"), binary = folder.bytes("sphere.stl");
    folder.text("empty.stl", "");
    folder.text("noFacet.stl", "solid nothing\nendsolid nothing\n");
    folder.text("truncated.stl", ascii.substr(0, ascii.size()/2));
    folder.text("truncatedBinary.stl", binary.substr(0, binary.size()/2));
    folder.text("truncated.ply", folder.bytes("torus.ply").substr(0, 5000));
    folder.text("truncated.off", folder.bytes("cone.off").substr(0, 900));
    folder.text("noIndex.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    folder.text("noNumber.obj", "v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n");
    folder.text("notFinite.off", "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n");
    folder.text("picture.stl", "\x89PNG\r\n\x1a\n and so on");
    folder.write("line.stl", rectangle(20, 0));
    folder.text("surface.step", "ISO-10303-21;\n");
}

}

int main(int argc, char** argv)
{
    if (argc != 2)
    {
        std::cerr << "usage: makeSurfaces FOLDER\n";
        return 1;
    }
    const Folder folder(argv[1]);
    writeWhole(folder);
    writeBroken(folder);
    writeUnusable(folder);
    return 0;
}
