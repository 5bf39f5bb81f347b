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

// A particle, or its image across sides of the box.
struct Image
{
    std::size_t particle;
    Vector3 place;                          // m
    Vector3 sign{1, 1, 1};                  // of the components of its vectors
};

// With what the sides of an axis add: a period to either side, or the mirror image.
void addAcross(std::vector<Image>& images, const BoxSides& sides, int axis)
{
    const std::size_t before = images.size();
    const auto add = [&](std::size_t k, double sign, double offset)
    {
        Image image = images[k];
        image.place[axis] = sign*image.place[axis] + offset;
        image.sign[axis] *= sign;
        images.push_back(image);
    };
    const auto& [lower, upper] = sides.kind[axis];
    const auto& [low, high] = sides.at[axis];
    for (std::size_t k = 0; k < before; ++k)
    {
        if (lower == BoxSides::Kind::cyclic)
        {
            add(k, 1, high - low);
            add(k, 1, low - high);
        }
        else if (lower == BoxSides::Kind::symmetryPlane) add(k, -1, 2*low);
        else if (upper == BoxSides::Kind::symmetryPlane) add(k, -1, 2*high);
    }
}

// Those in a box: surfaces are of the liquid as a whole, with its mirror images, and of bodies in one piece that lie across cyclic sides.
std::vector<Image> imagesIn(const Vector3& low, const Vector3& high, const std::vector<Vector3>& particles, const std::optional<BoxSides>& sides)
{
    std::vector<Image> chosen, images;
    for (std::size_t i = 0; i < particles.size(); ++i)
    {
        images.assign(1, Image{i, particles[i]});
        for (int axis = 0; sides && axis < 3; ++axis) addAcross(images, *sides, axis);
        for (const Image& image : images)
        {
            const Vector3& x = image.place;
            if (x.x >= low.x && x.y >= low.y && x.z >= low.z && x.x <= high.x && x.y <= high.y && x.z <= high.z) chosen.push_back(image);
        }
    }
    return chosen;
}

// A field's values of those.
void append(FieldData& to, const FieldData& from, const std::vector<Image>& images)
{
    if (from.uniform) return;
    const int components = componentsOf(from.type);
    for (const Image& image : images)
    {
        for (int c = 0; c < components; ++c) to.values.push_back((from.type == FieldType::vector ? image.sign[c] : 1)*from(image.particle, c));
    }
}

}

SurfaceFields::SurfaceFields(const std::filesystem::path& casePath, double spacing, const LiquidFields& fields, const Communicator& parts)
: case_(casePath), spacing_(spacing), fields_(fields), parts_(parts), sides_(BoxSides::read(casePath)), near_(casePath, spacing), bodies_(spacing)
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
        const std::vector<Image> chosen = imagesIn(low, high, particles, sides_);
        for (const Image& image : chosen) near.push_back(image.place);
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
