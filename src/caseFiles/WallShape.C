// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/WallShape.H"

#include "meshes/NearestPoint.H"

#include <algorithm>

namespace shizuku
{

namespace
{

class AnalyticShape : public WallShape
{
public:
    explicit AnalyticShape(const AnalyticSurface& surface) : surface_(surface) {}

    WallPoint at(const Vector3& x) const override { return {surface_.signedDistance(x), surface_.normal(x)}; }

private:
    AnalyticSurface surface_;
};

// The zero level of  constant + linear.x + square x.x , whose gradient fits the normals.
struct AlgebraicSphere
{
    double constant = 0, square = 0;
    Vector3 linear;

    WallPoint at(const Vector3& x) const
    {
        const double value = constant + dot(linear, x) + square*dot(x, x);
        const Vector3 gradient = linear + 2*square*x;
        const double steepness = length(gradient);
        const double onSurface = std::sqrt(std::max(0.0, steepness*steepness - 4*square*value));
        return {2*value/(steepness + onSurface), gradient/steepness};
    }
};

class SampledShape : public WallShape
{
public:
    SampledShape(std::vector<Vector3> positions, std::vector<Vector3> normals, double spacing)
    : positions_(std::move(positions)), normals_(std::move(normals)), spacing_(spacing), nearest_(positions_)
    {}

    WallPoint at(const Vector3& x) const override
    {
        constexpr int steps = 3;                // the foot's change halves with each, from a spacing to begin with
        Vector3 foot = positions_[nearest_(x)];
        WallPoint wall{};
        for (int step = 0; step < steps; ++step)
        {
            wall = sphereNear(foot).at(x - foot);
            foot = x - wall.distance*wall.normal;
        }
        return {wall.distance - 0.5*spacing_, wall.normal};
    }

private:
    // In coordinates from the foot.
    AlgebraicSphere sphereNear(const Vector3& foot) const
    {
        constexpr std::size_t neighbours = 16;
        const std::vector<std::size_t> near = nearest_(foot, std::min(neighbours, positions_.size()));
        const double reach = 1.01*length(positions_[near.back()] - foot) + 1e-3*spacing_;
        double weights = 0, pn = 0, pp = 0;
        Vector3 p, n;
        for (const std::size_t i : near)
        {
            const Vector3 position = positions_[i] - foot;
            const double w = std::pow(1 - squaredLength(position)/(reach*reach), 2);
            weights += w;
            p += w*position;
            n += w*normals_[i];
            pn += w*dot(position, normals_[i]);
            pp += w*dot(position, position);
        }
        const double spread = pp - dot(p, p)/weights;
        AlgebraicSphere sphere;
        sphere.square = spread > 0 ? 0.5*(pn - dot(p, n)/weights)/spread : 0;
        sphere.linear = (n - 2*sphere.square*p)/weights;
        sphere.constant = -(dot(sphere.linear, p) + sphere.square*pp)/weights;
        return sphere;
    }

    std::vector<Vector3> positions_, normals_;
    double spacing_;
    NearestPoint nearest_;
};

}

std::unique_ptr<WallShape> makeWallShape(const Plane& plane)
{
    AnalyticSurface surface;
    surface.point = plane.point;
    surface.direction = plane.normal;
    return std::make_unique<AnalyticShape>(surface);
}

std::unique_ptr<WallShape> makeWallShape(const CaseWalls& walls, const std::string& name, double spacing)
{
    for (const AnalyticSurface& surface : walls.analytic)
    {
        if (surface.name == name) return std::make_unique<AnalyticShape>(surface);
    }
    if (const auto plane = planeOf(walls, name, spacing)) return makeWallShape(*plane);
    const SolidParticles& solid = walls.solid;
    std::vector<Vector3> positions, normals;
    for (std::size_t i = 0; i < solid.positions.size(); ++i)
    {
        if (solid.patches[solid.patch[i]] != name) continue;
        positions.push_back(solid.positions[i]);
        normals.push_back(solid.normals[i]);
    }
    if (positions.empty())
    {
        throw FatalInputError({"constant/solid/patch", 0}, "The wall '" + name + "' has no solid particles");
    }
    return std::make_unique<SampledShape>(std::move(positions), std::move(normals), spacing);
}

}
