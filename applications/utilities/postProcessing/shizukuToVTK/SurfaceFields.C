// SPDX-License-Identifier: GPL-3.0-or-later
#include "SurfaceFields.H"

#include "caseFiles/LiquidFiles.H"
#include "meshes/Bounds.H"
#include "meshes/FieldsAt.H"
#include "meshes/MeshCurvature.H"
#include "meshes/VertexNeighbours.H"
#include "parallel/AllParts.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

bool hasLiquid(const TimeFolder& time) { return std::filesystem::exists(time.path/"liquid/positions"); }

// Of a mesh with edges of one face alone: there the curvature is not that of the surface.
FieldData curvatureOf(const TriangleMesh& mesh)
{
    constexpr Dimensions perLength{{0, -1, 0, 0, 0, 0, 0}};
    FieldData curvature{"curvature", FieldType::scalar, perLength, false, meanCurvature(mesh)};
    const VertexNeighbours neighbours(mesh);
    // A neighbour comes once for each face that it shares.
    std::vector<bool> atEdge(mesh.vertices.size());
    for (std::size_t v = 0; v < atEdge.size(); ++v)
    {
        neighbours.forEach(v, [&](int j)
        {
            int shared = 0;
            neighbours.forEach(v, [&](int k) { shared += k == j; });
            if (shared == 1) atEdge[v] = true;
        });
    }
    for (std::size_t v = 0; v < atEdge.size(); ++v)
    {
        if (!atEdge[v]) continue;
        double sum = 0;
        int n = 0;
        neighbours.forEach(v, [&](int j)
        {
            if (atEdge[j]) return;
            sum += curvature.values[j];
            ++n;
        });
        curvature.values[v] = n > 0 ? sum/n : std::nan("");
    }
    return curvature;
}

// Some of the elements of a field.
void append(FieldData& to, const FieldData& from, const std::vector<std::size_t>& elements)
{
    if (from.uniform) return;
    const int components = componentsOf(from.type);
    for (const std::size_t i : elements)
    {
        for (int c = 0; c < components; ++c) to.values.push_back(from(i, c));
    }
}

}

SurfaceFields::SurfaceFields(const std::filesystem::path& casePath, double spacing, const LiquidFields& fields, const Communicator& parts)
: case_(casePath), spacing_(spacing), fields_(fields), parts_(parts), near_(casePath, spacing), bodies_(spacing)
{}

void SurfaceFields::start(const TimeFolder& time)
{
    time_ = time;
    body_.clear();
    inAllParts(parts_, [&]
    {
        if (parts_.part() > 0 || !hasLiquid(time)) return;
        const std::vector<Vector3> particles = readLiquidPositions(time.path);
        body_ = bodies_.next(particles, readLiquidIds(time.path, particles.size()));
    });
    if (parts_.parts() > 1) body_ = listOfFirst(parts_, body_);
}

VtpContent SurfaceFields::of(const TriangleMesh& mesh)
{
    VtpContent surface = vtpOf(mesh);
    if (mesh.vertices.empty()) return surface;
    surface.pointFields.push_back(curvatureOf(mesh));
    if (near_.any()) surface.pointFields.push_back(thetaAt(mesh.vertices));
    for (FieldData& field : liquidAt(mesh.vertices))
    {
        const auto same = [&](const FieldData& other) { return other.name == field.name; };
        if (std::none_of(surface.pointFields.begin(), surface.pointFields.end(), same)) surface.pointFields.push_back(std::move(field));
    }
    return surface;
}

// What the case prescribes, where a wall is.
FieldData SurfaceFields::thetaAt(const std::vector<Vector3>& places)
{
    constexpr double near = 0.75;           // spacings
    near_.readTheta(time_.value);
    FieldData theta{"theta", FieldType::scalar, dimensions::none, false, {}};
    for (const Vector3& x : places)
    {
        const auto wall = near_.at(x, near*spacing_);
        theta.values.push_back(wall ? wall->theta : std::nan(""));
    }
    return theta;
}

// Reads the particles in turns, and keeps those that are near: a part never holds more than these.
std::vector<FieldData> SurfaceFields::liquidAt(const std::vector<Vector3>& places) const
{
    constexpr std::size_t turn = 4000000;
    constexpr double reach = 3;             // spacings: more than places take of particles
    if (body_.empty()) return {};
    const Bounds box = boundsOf(places);
    const Vector3 margin = reach*spacing_*Vector3(1, 1, 1), low = box.low - margin, high = box.high + margin;
    std::vector<Vector3> near;
    std::vector<FieldData> fields;
    for (std::size_t first = 0; first < body_.size(); first += turn)
    {
        const std::size_t end = std::min(body_.size(), first + turn);
        const auto choose = [&](std::size_t) { return ElementRange{first, end}; };
        const std::vector<Vector3> particles = readLiquidPositions(time_.path, choose);
        std::vector<FieldData> of = fields_.read(time_.path, body_.size(), choose);
        of.push_back({"body", FieldType::label, dimensions::none, false, {body_.begin() + long(first), body_.begin() + long(end)}});
        std::vector<std::size_t> chosen;
        for (std::size_t i = 0; i < particles.size(); ++i)
        {
            const Vector3& x = particles[i];
            const bool isIn = x.x >= low.x && x.y >= low.y && x.z >= low.z && x.x <= high.x && x.y <= high.y && x.z <= high.z;
            if (isIn) chosen.push_back(i);
        }
        for (const std::size_t i : chosen) near.push_back(particles[i]);
        for (std::size_t f = 0; f < of.size(); ++f)
        {
            if (first == 0)
            {
                fields.push_back(of[f]);
                if (!of[f].uniform) fields[f].values.clear();
            }
            append(fields[f], of[f], chosen);
        }
    }
    return fieldsAt(places, near, fields, spacing_);
}

}
