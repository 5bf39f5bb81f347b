#include "liquidBodies/LiquidChecks.H"

#include "meshes/NearestPoint.H"

#include <algorithm>
#include <functional>

namespace shizuku
{

namespace
{

constexpr double wallDistance = 0.4;                // spacings: the rows of a box may be that much narrower than one
constexpr double solidDistance = 0.9;               // spacings
constexpr double liquidDistance = 0.5*(1 - 1e-6);   // spacings; bodies that touch are there but for rounding

// Refuses or leaves out the particles of the body for which `bad` is true.
void keepOut
(
    FilledBody& body, const std::string& what, const std::string& expected,
    const std::function<bool(const Vector3&)>& bad
)
{
    const auto first = std::find_if(body.positions.begin(), body.positions.end(), bad);
    if (first == body.positions.end()) return;
    std::vector<Vector3> good(body.positions.begin(), first), inTheWay;
    for (auto x = first; x != body.positions.end(); ++x) (bad(*x) ? inTheWay : good).push_back(*x);
    const std::string count = std::to_string(inTheWay.size());
    if (!body.carve || good.empty())
    {
        throw FatalInputError
        (
            body.where,
            what + ": " + count + " of the " + std::to_string(body.positions.size())
                + " particles of the body '" + body.name + "', the first one at " + str(inTheWay.front()) + " m",
            expected + (body.carve ? "" : "; or `overlaps carve;`, which leaves them out")
        );
    }
    body.leftOut.push_back(count + " particles: " + what);
    body.positions = std::move(good);
}

void keepOutOf(FilledBody& body, const FilledBody& other, double spacing)
{
    const NearestPoint nearest(other.positions);
    keepOut
    (
        body, "Liquid inside of other liquid, the body '" + other.name + "'",
        "bodies that do not overlap, and whose particles are at least half a spacing apart",
        [&](const Vector3& x)
        {
            return other.shape->contains(x) || length(x - other.positions[nearest(x)]) < liquidDistance*spacing;
        }
    );
}

}

void keepOutOfWalls(FilledBody& body, const std::vector<AnalyticSurface>& walls, double spacing)
{
    for (const AnalyticSurface& wall : walls)
    {
        keepOut
        (
            body, "Liquid inside a solid, the " + typeName(wall.type) + " '" + wall.name + "'",
            "particles on the liquid's side, about half a spacing from the wall",
            [&](const Vector3& x) { return wall.signedDistance(x) < wallDistance*spacing; }
        );
    }
}

void keepOutOfSolid(FilledBody& body, const SolidParticles& solid, double spacing)
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
        keepOut
        (
            body, "Liquid inside a solid, the wall '" + solid.patches[patch] + "'",
            "particles in front of the wall, at least 0.9 spacings from its particles",
            [&](const Vector3& x) { return patchBehind(x) == static_cast<int>(patch); }
        );
    }
}

void keepApart(std::vector<FilledBody>& bodies, double spacing)
{
    for (auto later = bodies.begin(); later != bodies.end(); ++later)
    {
        for (auto earlier = bodies.begin(); earlier != later; ++earlier)
        {
            if (later->carve || !earlier->carve) keepOutOf(*later, *earlier, spacing);
            if (!later->carve) keepOutOf(*earlier, *later, spacing);
        }
    }
}

}
