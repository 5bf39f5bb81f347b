#include "geometry/ContactAngle.H"

#include "geometry/SphereFit.H"

#include <algorithm>
#include <limits>
#include <numbers>

namespace shizuku
{

namespace
{

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// What the drop hides of the wall: the faces that look away from the wall, projected on it. Exact as long as no
// part of the drop overhangs another.
double projectedArea(const TriangleMesh& mesh, const Vector3& normal)
{
    double area = 0;
    for (const auto& [i, j, k] : mesh.faces)
    {
        const Vector3 faceArea = 0.5*cross(mesh.vertices[j] - mesh.vertices[i], mesh.vertices[k] - mesh.vertices[i]);
        area += std::max(0.0, dot(faceArea, normal));
    }
    return area;
}

}

std::string word(DropState state)
{
    switch (state)
    {
        case DropState::attached: return "attached";
        case DropState::detached: return "detached";
        case DropState::film: break;
    }
    return "film";
}

ContactAngle measureContactAngle
(
    const TriangleMesh& drop, const Plane& wall, double spacing, const ContactAngleLimits& limits
)
{
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    std::vector<Vector3> cap;
    for (const Vector3& vertex : drop.vertices)
    {
        const double height = wall.distance(vertex);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
        if (height > limits.fitAbove*spacing) cap.push_back(vertex);
    }

    ContactAngle result;
    result.angle = result.residual = none;
    result.height = highest;
    result.coveredArea = projectedArea(drop, wall.normal);

    if (lowest > limits.detachedAbove*spacing)
    {
        result.state = DropState::detached;
        return result;
    }

    const auto sphere = highest < limits.filmBelow*spacing ? std::nullopt : fitSphere(cap);
    if (!sphere)
    {
        result.state = DropState::film;
        result.contactRadius = std::sqrt(result.coveredArea/std::numbers::pi);
        return result;
    }

    // A sphere that ends above the wall, by less than the drop's allowed gap, touches it in a point: 180 degrees.
    const double cosine = std::clamp(-wall.distance(sphere->centre)/sphere->radius, -1.0, 1.0);
    result.angle = std::acos(cosine)*180/std::numbers::pi;
    result.contactRadius = sphere->radius*std::sqrt(1 - cosine*cosine);
    result.residual = sphere->rms/spacing;
    return result;
}

}
