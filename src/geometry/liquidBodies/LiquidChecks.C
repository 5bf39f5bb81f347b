#include "geometry/liquidBodies/LiquidChecks.H"

#include "geometry/NearestPoint.H"

#include <functional>

namespace shizuku
{

namespace
{

constexpr double wallDistance = 0.5*(1 - 1e-6);     // spacings; a lattice on the wall is there but for rounding
constexpr double solidDistance = 0.9;               // spacings
constexpr double liquidDistance = 0.5*(1 - 1e-6);   // spacings

// Throws where `bad` is true of any particle of the body.
void refuse
(
    const FilledBody& body, const std::string& what, const std::string& expected,
    const std::function<bool(const Vector3&)>& bad
)
{
    std::size_t count = 0;
    Vector3 first;
    for (const Vector3& x : body.positions)
    {
        if (!bad(x)) continue;
        if (count++ == 0) first = x;
    }
    if (count == 0) return;
    throw FatalInputError
    (
        body.where,
        what + ": " + std::to_string(count) + " of the " + std::to_string(body.positions.size())
            + " particles of the body '" + body.name + "', the first one at " + str(first) + " m",
        expected
    );
}

}

void refuseInsideWalls(const FilledBody& body, const std::vector<AnalyticSurface>& walls, double spacing)
{
    for (const AnalyticSurface& wall : walls)
    {
        refuse
        (
            body, "Liquid inside a solid, the " + typeName(wall.type) + " '" + wall.name + "'",
            "particles on the liquid's side, at least half a spacing from the wall",
            [&](const Vector3& x) { return wall.signedDistance(x) < wallDistance*spacing; }
        );
    }
}

void refuseInsideSolid(const FilledBody& body, const SolidParticles& solid, double spacing)
{
    if (solid.positions.empty()) return;
    const NearestPoint nearest(solid.positions);
    const auto patchBehind = [&](const Vector3& x) -> int
    {
        const std::size_t k = nearest(x);
        const Vector3 r = x - solid.positions[k];
        const double height = dot(r, solid.normals[k]);
        // Behind the layer, but not beside its border: there the nearest particle is far off to one side.
        const bool behind = height < 0 && squaredLength(r) - height*height < spacing*spacing;
        return behind || squaredLength(r) < solidDistance*solidDistance*spacing*spacing ? solid.patch[k] : -1;
    };
    for (std::size_t patch = 0; patch < solid.patches.size(); ++patch)
    {
        refuse
        (
            body, "Liquid inside a solid, the wall '" + solid.patches[patch] + "'",
            "particles in front of the wall, at least 0.9 spacings from its particles",
            [&](const Vector3& x) { return patchBehind(x) == static_cast<int>(patch); }
        );
    }
}

void refuseOverlaps(const std::vector<FilledBody>& bodies, double spacing)
{
    for (const FilledBody& other : bodies)
    {
        const NearestPoint nearest(other.positions);
        for (const FilledBody& body : bodies)
        {
            if (&body == &other) continue;
            refuse
            (
                body, "Liquid inside of other liquid, the body '" + other.name + "'",
                "bodies that do not overlap, and whose particles are at least half a spacing apart",
                [&](const Vector3& x)
                {
                    return other.shape->contains(x)
                     || length(x - other.positions[nearest(x)]) < liquidDistance*spacing;
                }
            );
        }
    }
}

}
