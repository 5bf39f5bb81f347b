#include "geometry/liquidBodies/LiquidBody.H"

#include <sstream>

namespace shizuku
{

namespace
{
    constexpr double maxParticles = 1e8;
}

BodyFrame BodyFrame::along(const Vector3& origin, const Vector3& z)
{
    const Vector3 x = perpendicular(z);
    return {origin, x, cross(z, x), z};
}

std::vector<Vector3> fillLattice(const LiquidBody& body, double spacing, const SourceLocation& where)
{
    if (body.volume() > maxParticles*spacing*spacing*spacing)
    {
        std::ostringstream found;
        found << "The body has a volume of " << body.volume() << " m3, which is " << body.volume()/std::pow(spacing, 3)
              << " particles of spacing " << spacing << " m";
        throw FatalInputError(where, found.str(), "at most 1e8 particles: lengths in metres, a larger spacing");
    }

    const BodyFrame frame = body.frame();
    const Vector3 low = body.low()/spacing, high = body.high()/spacing;
    std::vector<Vector3> points;
    for (double k = std::floor(low.z) + 0.5; k < high.z; ++k)
    for (double j = std::floor(low.y) + 0.5; j < high.y; ++j)
    for (double i = std::floor(low.x) + 0.5; i < high.x; ++i)
    {
        const Vector3 x = frame.origin + spacing*(i*frame.x + j*frame.y + k*frame.z);
        if (body.contains(x)) points.push_back(x);
    }
    if (points.empty())
    {
        std::ostringstream found;
        found << "The body is smaller than the particle spacing of " << spacing << " m: no particle is inside";
        throw FatalInputError(where, found.str(), "a larger body, or a smaller spacing in system/solution");
    }
    return points;
}

Vector3 readUnitVector(const Dictionary& dict, const std::string& key)
{
    const Vector3 vector = dict.lookup<std::array<double, 3>>(key);
    const double l = length(vector);
    if (!(l > 0) || !std::isfinite(l))
    {
        throw FatalInputError
        (
            dict.where(key), "The " + key + " " + str(vector) + " of " + dict.name() + " has no direction",
            "a vector of any length but zero"
        );
    }
    return vector/l;
}

}
