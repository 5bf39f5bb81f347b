#include "geometry/SeparateBodies.H"

#include "geometry/ConnectedPoints.H"

#include <algorithm>
#include <numbers>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr double reach = 1.5;               // spacings between particles of one body

}

double SeparateBody::diameter() const { return std::cbrt(6*volume/std::numbers::pi); }

std::vector<SeparateBody> separateBodies
(
    const std::vector<Vector3>& positions, const std::vector<Vector3>& velocities, double spacing
)
{
    const Vector3 half = 0.5*Vector3(spacing, spacing, spacing);
    std::vector<SeparateBody> bodies;
    for (const std::vector<int>& group : connectedPoints(positions, reach*spacing))
    {
        SeparateBody body{group, positions[group.front()], positions[group.front()], {}, 0};
        body.volume = double(group.size())*spacing*spacing*spacing;
        for (const int i : group)
        {
            body.velocity += velocities[i]/double(group.size());
            for (int c = 0; c < 3; ++c)
            {
                body.low[c] = std::min(body.low[c], positions[i][c]);
                body.high[c] = std::max(body.high[c], positions[i][c]);
            }
        }
        body.low -= half;
        body.high += half;
        bodies.push_back(body);
    }
    return bodies;
}

std::string describe(const SeparateBody& body, double spacing)
{
    const double diameter = body.diameter();
    std::ostringstream text;
    text << body.particles.size() << " particles, volume " << body.volume << " m3\n"
         << "    size " << str(body.size()) << " m, " << str(body.size()/spacing) << " spacings\n"
         << "    sphere of its volume: diameter D " << diameter << " m, " << diameter/(2*spacing) << " spacings a radius\n"
         << "    mean velocity " << str(body.velocity) << " m/s\n";
    return text.str();
}

}
