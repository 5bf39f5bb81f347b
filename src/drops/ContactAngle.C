// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/ContactAngle.H"

#include "core/angles/Degrees.H"
#include "meshes/SphereFit.H"

#include <algorithm>
#include <limits>
#include <numbers>
#include <optional>

namespace shizuku
{

namespace
{

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// What the drop hides of the wall: the faces that look away from the wall, moved down to it. Exact as long as no part of
// the drop overhangs another.
double projectedArea(const TriangleMesh& mesh, const std::vector<WallPoint>& wall)
{
    const auto foot = [&](int i) { return mesh.vertices[i] - wall[i].distance*wall[i].normal; };
    double area = 0;
    for (const auto& [i, j, k] : mesh.faces)
    {
        const Vector3 faceArea = 0.5*cross(foot(j) - foot(i), foot(k) - foot(i));
        area += std::max(0.0, dot(faceArea, normalized(wall[i].normal + wall[j].normal + wall[k].normal)));
    }
    return area;
}

// Where a sphere cuts a wall: the mean angle and radius of the cut.
struct Cut
{
    double angle, radius;
};

// Along great circles from the sphere's top down to where they enter the wall: below the wall's surface nothing is asked,
// for a thin wall ends there, and the sphere may reach through it. Nothing where the sphere's top lies inside the wall, or
// the wall does not go round it. up: the wall's mean normal under the drop.
std::optional<Cut> cutOf(const SphereFit& sphere, const WallShape& wall, const Vector3& up)
{
    constexpr int directions = 48, steps = 180, halvings = 50;
    const Vector3 x = perpendicular(up), y = cross(-up, x);
    const auto at = [&](double polar, const Vector3& sideways)
    {
        return sphere.centre + sphere.radius*(std::sin(polar)*sideways - std::cos(polar)*up);
    };

    std::vector<Vector3> points;
    double angles = 0;
    for (int i = 0; i < directions; ++i)
    {
        const double azimuth = 2*std::numbers::pi*i/directions;
        const Vector3 sideways = std::cos(azimuth)*x + std::sin(azimuth)*y;
        const auto distance = [&](double polar) { return wall.at(at(polar, sideways)).distance; };
        double from = std::numbers::pi, to = from;
        for (int step = steps - 1; step >= 0 && distance(to) >= 0; --step)
        {
            from = to;
            to = std::numbers::pi*step/steps;
        }
        if (from == to) return std::nullopt;
        if (distance(to) >= 0) continue;
        for (int k = 0; k < halvings; ++k)
        {
            const double middle = 0.5*(from + to);
            (distance(middle) < 0 ? to : from) = middle;
        }
        points.push_back(at(to, sideways));
        const Vector3 normal = (points.back() - sphere.centre)/sphere.radius;
        angles += degrees(std::acos(std::clamp(dot(normal, wall.at(points.back()).normal), -1.0, 1.0)));
    }
    // A sphere that ends above the wall, by less than the drop's allowed gap, touches it in a point.
    if (points.empty()) return Cut{180, 0};
    if (points.size() < directions) return std::nullopt;
    Vector3 middle;
    for (const Vector3& p : points) middle += p/directions;
    double radius = 0;
    for (const Vector3& p : points) radius += length(p - middle)/directions;
    return Cut{angles/directions, radius};
}

// The wall's mean normal under the vertices nearest to it, those not higher than `above`.
Vector3 normalUnder(const std::vector<WallPoint>& wall, double above)
{
    Vector3 sum;
    for (const WallPoint& p : wall) if (p.distance <= above) sum += p.normal;
    return normalized(sum);
}

// The sphere above the wall's neighbourhood, where the drop bends as a drop does: its surface looks away from the centre.
std::optional<SphereFit> fitCap
(
    const TriangleMesh& drop, const std::vector<WallPoint>& wall, double above
)
{
    const std::vector<double> areas = drop.vertexAreas();
    std::vector<Vector3> cap;
    std::vector<double> weights;
    for (std::size_t i = 0; i < drop.vertices.size(); ++i)
    {
        if (wall[i].distance <= above) continue;
        cap.push_back(drop.vertices[i]);
        weights.push_back(areas[i]);
    }
    const auto sphere = fitSphere(cap, weights);
    if (!sphere) return sphere;
    double outward = 0;
    for (const auto& [i, j, k] : drop.faces)
    {
        if (std::min({wall[i].distance, wall[j].distance, wall[k].distance}) <= above) continue;
        const Vector3& a = drop.vertices[i];
        outward += dot(cross(drop.vertices[j] - a, drop.vertices[k] - a), a - sphere->centre);
    }
    return outward > 0 ? sphere : std::nullopt;
}

// Its mean distance from its middle.
double radiusOf(const std::vector<LineTangent>& line)
{
    Vector3 middle;
    double total = 0, radius = 0;
    for (const LineTangent& tangent : line)
    {
        middle += tangent.length*tangent.point;
        total += tangent.length;
    }
    for (const LineTangent& tangent : line) radius += tangent.length*length(tangent.point - middle/total);
    return radius/total;
}

// The part of the direction along the wall under the contact line; zero where that is hardly any.
Vector3 alongWall(const Vector3& direction, const std::vector<LineTangent>& line, const WallShape& wall)
{
    constexpr double least = 0.0087;            // sine of half a degree
    Vector3 middle;
    for (const LineTangent& tangent : line) middle += tangent.point/line.size();
    const Vector3 normal = wall.at(middle).normal, along = direction - dot(direction, normal)*normal;
    return length(along) > least*length(direction) ? along : Vector3();
}

void summarise(ContactAngle& result, const WallShape& wall, const Vector3& direction)
{
    result.mean = result.min = result.max = result.advancing = result.receding = result.lineRadius = none;
    if (result.line.empty()) return;
    result.lineRadius = radiusOf(result.line);
    double sum = 0, total = 0;
    for (const LineTangent& tangent : result.line)
    {
        sum += tangent.length*tangent.angle;
        total += tangent.length;
    }
    result.mean = sum/total;
    const auto by = [](auto property)
    {
        return [property](const LineTangent& a, const LineTangent& b) { return property(a) < property(b); };
    };
    const auto [min, max] = std::minmax_element(result.line.begin(), result.line.end(), by([](auto& t) { return t.angle; }));
    result.min = min->angle;
    result.max = max->angle;
    const Vector3 ahead = alongWall(direction, result.line, wall);
    if (length(ahead) == 0) return;
    const auto [back, front] = std::minmax_element
    (
        result.line.begin(), result.line.end(), by([&](auto& t) { return dot(t.outward, ahead); })
    );
    result.advancing = front->angle;
    result.receding = back->angle;
}

// Whether the drop touches the wall from several sides that look at each other, as between two plates or in a corner: where it touches,
// normals differ by more than 80 degrees, and one place lies well in front of the other. (Round a convex edge none does.)
bool hasFacingSides(const TriangleMesh& drop, const std::vector<WallPoint>& wall, double above)
{
    constexpr double cosine = 0.17;
    constexpr std::size_t sample = 50;
    std::vector<std::size_t> touching;
    for (std::size_t i = 0; i < wall.size(); ++i) if (wall[i].distance <= above) touching.push_back(i);
    const std::size_t stride = 1 + touching.size()/sample;
    for (std::size_t k = 0; k < touching.size(); k += stride)
    {
        const std::size_t i = touching[k];
        const auto faces = [&](std::size_t j)
        {
            return dot(wall[i].normal, wall[j].normal) < cosine && dot(drop.vertices[j] - drop.vertices[i], wall[i].normal) > 2*above;
        };
        if (std::any_of(touching.begin(), touching.end(), faces)) return true;
    }
    return false;
}

// Whether it touches another wall, away from the neighbourhood of this one.
bool touchesOthers(const TriangleMesh& drop, const std::vector<double>& height, const DistanceToWalls& others, double above)
{
    for (std::size_t i = 0; others && i < height.size(); ++i)
    {
        if (height[i] > 2*above && others(drop.vertices[i]) <= above) return true;
    }
    return false;
}

}

std::string word(DropState state)
{
    switch (state)
    {
        case DropState::attached: return "attached";
        case DropState::detached: return "detached";
        case DropState::film: return "film";
        case DropState::bridge: break;
    }
    return "bridge";
}

ContactAngle measureContactAngle
(
    const TriangleMesh& drop, const WallShape& wall, double spacing, const Vector3& direction,
    const ContactAngleLimits& limits, const DistanceToWalls& others
)
{
    std::vector<WallPoint> atWall;
    std::vector<double> height;
    for (const Vector3& vertex : drop.vertices)
    {
        atWall.push_back(wall.at(vertex));
        height.push_back(atWall.back().distance);
    }
    const auto [lowest, highest] = std::minmax_element(height.begin(), height.end());

    ContactAngle result;
    result.angle = result.residual = none;
    result.height = *highest;
    result.coveredArea = projectedArea(drop, atWall);
    summarise(result, wall, direction);

    if (*lowest > limits.detachedAbove*spacing)
    {
        result.state = DropState::detached;
        return result;
    }

    const double above = limits.fitAbove*spacing;
    if (hasFacingSides(drop, atWall, above) || touchesOthers(drop, height, others, above))
    {
        result.state = DropState::bridge;
        result.line = contactLine(drop, height, wall, above, spacing);
        summarise(result, wall, direction);
        result.contactRadius = result.lineRadius;
        return result;
    }
    const auto sphere = *highest < limits.filmBelow*spacing ? std::nullopt : fitCap(drop, atWall, above);
    const auto cut = sphere ? cutOf(*sphere, wall, normalUnder(atWall, std::max(above, *lowest))) : std::nullopt;
    if (!cut)
    {
        result.state = DropState::film;
        result.contactRadius = std::sqrt(result.coveredArea/std::numbers::pi);
        return result;
    }
    result.angle = cut->angle;
    result.contactRadius = cut->radius;
    result.residual = sphere->rms/spacing;
    result.line = contactLine(drop, height, wall, above, spacing);
    summarise(result, wall, direction);
    return result;
}

}
