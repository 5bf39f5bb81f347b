// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PlyFile.H"

#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"
#include "meshes/PlyHeader.H"
#include "meshes/PolygonTriangles.H"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iomanip>
#include <limits>

namespace shizuku
{

static_assert(std::endian::native == std::endian::little, "binary PLY is written in the machine's byte order");

namespace
{

class PlyReader
{
public:
    explicit PlyReader(const std::filesystem::path& file) : file_(file), in_(file, std::ios::binary)
    {
        if (!in_) fail("Cannot read the mesh", "a PLY file");
        header_ = PlyHeader::read(in_, file_);
    }

    TriangleMesh read()
    {
        for (const PlyElement& element : header_.elements)
        {
            if (element.name == "vertex") readVertices(element);
            else if (element.name == "face") readFaces(element);
            else for (std::size_t i = 0; i < element.count; ++i) readRecord(element);
        }
        for (const auto& face : mesh_.faces) checkIndices(face);
        for (const std::vector<int>& polygon : polygons_)
        {
            checkIndices(polygon);
            const auto triangles = trianglesOf(mesh_.vertices, polygon);
            mesh_.faces.insert(mesh_.faces.end(), triangles.begin(), triangles.end());
        }
        return std::move(mesh_);
    }

private:
    [[noreturn]] void fail(const std::string& found, const std::string& expected = "") const
    {
        throw FatalInputError({file_.string(), header_.lines}, found, expected);
    }

    template<class T> double binaryValue()
    {
        std::array<char, sizeof(T)> bytes{};
        in_.read(bytes.data(), bytes.size());
        if (header_.bigEndian) std::reverse(bytes.begin(), bytes.end());
        return double(std::bit_cast<T>(bytes));
    }

    double value(PlyScalar type)
    {
        double result = 0;
        if (header_.ascii)
        {
            std::string text;
            in_ >> text;
            char* end = nullptr;
            result = std::strtod(text.c_str(), &end);
            if (in_ && *end != '\0') fail("'" + text + "' in element " + position_, "a number");
            if (type == PlyScalar::float32) result = float(result);    // as it was before it became text
        }
        else switch (type)
        {
            case PlyScalar::int8: result = binaryValue<std::int8_t>(); break;
            case PlyScalar::uint8: result = binaryValue<std::uint8_t>(); break;
            case PlyScalar::int16: result = binaryValue<std::int16_t>(); break;
            case PlyScalar::uint16: result = binaryValue<std::uint16_t>(); break;
            case PlyScalar::int32: result = binaryValue<std::int32_t>(); break;
            case PlyScalar::uint32: result = binaryValue<std::uint32_t>(); break;
            case PlyScalar::float32: result = binaryValue<float>(); break;
            case PlyScalar::float64: result = binaryValue<double>(); break;
        }
        if (!in_) fail("The file ends within element " + position_);
        return result;
    }

    // Values of one element, one vector a property.
    const std::vector<std::vector<double>>& readRecord(const PlyElement& element)
    {
        record_.resize(element.properties.size());
        for (std::size_t p = 0; p < element.properties.size(); ++p)
        {
            const PlyProperty& property = element.properties[p];
            const double count = property.list ? value(property.countType) : 1;
            if (!(count >= 0 && count <= std::numeric_limits<int>::max())) fail("A list of impossible length in element " + position_);
            record_[p].clear();
            for (long i = 0; i < long(count); ++i) record_[p].push_back(value(property.type));
        }
        return record_;
    }

    static int find(const PlyElement& element, const std::string& name)
    {
        for (std::size_t p = 0; p < element.properties.size(); ++p)
        {
            if (element.properties[p].name == name) return int(p);
        }
        return -1;
    }

    void readVertices(const PlyElement& element)
    {
        const std::array<int, 3> at{find(element, "x"), find(element, "y"), find(element, "z")};
        const std::array<int, 3> normalAt{find(element, "nx"), find(element, "ny"), find(element, "nz")};
        for (const int p : at)
        {
            if (p < 0 || element.properties[p].list) fail("Element vertex has no coordinates", "properties x, y, z");
        }
        bool normals = true;
        for (const int p : normalAt) normals = normals && p >= 0 && !element.properties[p].list;

        const auto vectorOf = [this](const std::vector<std::vector<double>>& record, const std::array<int, 3>& where)
        {
            const Vector3 v(record[where[0]][0], record[where[1]][0], record[where[2]][0]);
            if (!std::isfinite(v.x + v.y + v.z)) fail("Not a finite number in element " + position_);
            return v;
        };
        for (std::size_t i = 0; i < element.count; ++i)
        {
            position_ = "vertex " + std::to_string(i);
            const auto& record = readRecord(element);
            mesh_.vertices.push_back(vectorOf(record, at));
            if (normals) mesh_.normals.push_back(vectorOf(record, normalAt));
        }
    }

    void readFaces(const PlyElement& element)
    {
        int at = find(element, "vertex_indices");
        if (at < 0) at = find(element, "vertex_index");
        if (at < 0 || !element.properties[at].list) fail("Element face has no vertices", "list vertex_indices");
        for (std::size_t i = 0; i < element.count; ++i)
        {
            position_ = "face " + std::to_string(i);
            const std::vector<double>& corners = readRecord(element)[at];
            if (corners.size() < 3) fail("Element " + position_ + " has fewer than three vertices");
            if (corners.size() == 3) mesh_.faces.push_back({index(corners[0]), index(corners[1]), index(corners[2])});
            else
            {
                polygons_.emplace_back();
                for (const double corner : corners) polygons_.back().push_back(index(corner));
            }
        }
    }

    int index(double value) const
    {
        const bool possible = value >= 0 && value <= std::numeric_limits<int>::max();
        if (!possible) fail("Vertex index out of range in " + position_);
        return int(value);
    }

    // After all elements, for vertices may follow the faces.
    template<class Corners> void checkIndices(const Corners& corners) const
    {
        for (const int corner : corners)
        {
            if (corner < int(mesh_.vertices.size())) continue;
            fail("A face names vertex " + std::to_string(corner), "an index below " + std::to_string(mesh_.vertices.size()));
        }
    }

    std::filesystem::path file_;
    std::ifstream in_;
    PlyHeader header_;
    std::vector<std::vector<double>> record_;
    std::string position_;              // "vertex 12", for messages
    TriangleMesh mesh_;
    std::vector<std::vector<int>> polygons_;    // of more than three corners
};

void writeHeader(std::ostream& out, const TriangleMesh& mesh, PlyFormat format)
{
    out << "ply\nformat " << (format == PlyFormat::ascii ? "ascii" : "binary_little_endian") << " 1.0\n"
        << "comment lengths in metres\n"
        << "element vertex " << mesh.vertices.size() << '\n'
        << "property double x\nproperty double y\nproperty double z\n";        // a mesh may lie far from the origin
    if (!mesh.normals.empty()) out << "property float nx\nproperty float ny\nproperty float nz\n";
    out << "element face " << mesh.faces.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
}

void writeAscii(std::ostream& out, const TriangleMesh& mesh)
{
    constexpr int ofPlaces = 14;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    {
        const Vector3& v = mesh.vertices[i];
        out << std::setprecision(ofPlaces) << v.x << ' ' << v.y << ' ' << v.z << std::setprecision(std::numeric_limits<float>::max_digits10);
        if (!mesh.normals.empty())
        {
            const Vector3& n = mesh.normals[i];
            out << ' ' << float(n.x) << ' ' << float(n.y) << ' ' << float(n.z);
        }
        out << '\n';
    }
    for (const auto& [i, j, k] : mesh.faces) out << "3 " << i << ' ' << j << ' ' << k << '\n';
}

void writeBinary(std::ostream& out, const TriangleMesh& mesh)
{
    std::string bytes;
    const auto append = [&bytes](const auto& value)
    {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    {
        for (int c = 0; c < 3; ++c) append(mesh.vertices[i][c]);
        if (mesh.normals.empty()) continue;
        for (int c = 0; c < 3; ++c) append(float(mesh.normals[i][c]));
    }
    for (const auto& face : mesh.faces)
    {
        append(std::uint8_t(3));
        for (const int corner : face) append(std::int32_t(corner));
    }
    out.write(bytes.data(), std::streamsize(bytes.size()));
}

}

TriangleMesh readPly(const std::filesystem::path& file)
{
    return PlyReader(file).read();
}

void writePly(const std::filesystem::path& file, const TriangleMesh& mesh, PlyFormat format)
{
    writeAtomically(file, [&](std::ostream& out)
    {
        writeHeader(out, mesh, format);
        if (format == PlyFormat::ascii) writeAscii(out, mesh);
        else writeBinary(out, mesh);
    });
}

}
