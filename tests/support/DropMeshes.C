// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/DropMeshes.H"

#include "support/CapMesh.H"

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cstdint>
#include <numbers>

namespace shizuku::test
{

namespace
{

// Of the ball's cap that a sphere cuts off, both meeting in a circle of radius r; z: of the cap's base from its centre.
double capVolume(double radius, double z)
{
    const double h = radius - z;
    return std::numbers::pi*h*h*(3*radius - h)/3;
}

// The drop's sphere of a given radius around (0 0 D): D by the law of cosines, D^2 = R^2 + Rb^2 - 2 R Rb cos(theta).
struct Lens
{
    double distance, volume, contactRadius;

    Lens(double theta, double R, double ball)
    {
        const double c = std::cos(theta*std::numbers::pi/180);
        distance = std::sqrt(R*R + ball*ball - 2*R*ball*c);
        const double z = (distance*distance + ball*ball - R*R)/(2*distance);        // of the contact circle
        contactRadius = std::sqrt(std::max(0.0, ball*ball - z*z));
        volume = capVolume(R, z - distance) - capVolume(ball, z);
    }
};

}

DropOnBall dropOnBall(double theta, double volume, double ballRadius, const Vector3& axis)
{
    const auto excess = [&](double logR) { return std::log(Lens(theta, std::exp(logR), ballRadius).volume/volume); };
    const double sphere = std::log(std::cbrt(volume));
    std::uintmax_t steps = 200;
    const auto [low, high] = boost::math::tools::toms748_solve
    (
        excess, sphere - 1, sphere + 3, boost::math::tools::eps_tolerance<double>(45), steps
    );
    const double R = std::exp(0.5*(low + high));
    const Lens lens(theta, R, ballRadius);
    return {ballRadius, R, lens.distance*axis, lens.contactRadius};
}

TriangleMesh dropOnBallMesh(const DropOnBall& drop, double cell)
{
    const auto distance = [&](const Vector3& p)
    {
        return std::max(length(p - drop.centre) - drop.radius, drop.ballRadius - length(p));
    };
    // The box around the half of the drop's sphere that looks away from the ball, and around the circle of contact.
    const Vector3 axis = normalized(drop.centre);
    const double z = std::sqrt(drop.ballRadius*drop.ballRadius - drop.contactRadius*drop.contactRadius);
    const double low = z - length(drop.centre);             // of the circle, from the sphere's centre
    const double wide = low < 0 ? drop.radius : drop.contactRadius;
    Vector3 min, max;
    for (int k = 0; k < 3; ++k)
    {
        const double across = wide*std::sqrt(1 - axis[k]*axis[k]);
        const double ends[] = {axis[k]*length(drop.centre) + axis[k]*drop.radius, axis[k]*z};
        min[k] = std::min(ends[0], ends[1]) - across;
        max[k] = std::max(ends[0], ends[1]) + across;
    }
    return marchTetrahedra(distance, min - cell*Vector3(1.37, 1.41, 1.29), max + cell*Vector3(1.5, 1.5, 1.5), cell);
}

TriangleMesh revolvedMesh(const DropProfile& profile, double cell)
{
    const auto outside = [&](double r, double z)            // of the polygon of the profile: its distance, signed
    {
        double nearest = HUGE_VAL, sign = 1;
        for (std::size_t i = 0; i + 1 < profile.points.size(); ++i)
        {
            const DropProfilePoint& a = profile.points[i];
            const DropProfilePoint& b = profile.points[i + 1];
            const double dx = b.x - a.x, dz = b.z - a.z;
            const double along = std::clamp(((r - a.x)*dx + (z - a.z)*dz)/(dx*dx + dz*dz), 0.0, 1.0);
            const double x = r - a.x - along*dx, y = z - a.z - along*dz, distance = std::hypot(x, y);
            if (distance >= nearest) continue;
            nearest = distance;
            sign = x*dz - y*dx > 0 ? 1 : -1;
        }
        return sign*nearest;
    };
    double widest = 0;
    for (const DropProfilePoint& p : profile.points) widest = std::max(widest, p.x);
    const auto distance = [&](const Vector3& p)
    {
        return std::max(outside(std::hypot(p.x, p.y), profile.height() - p.z), -p.z);
    };
    const Vector3 low(-widest, -widest, 0), high(widest, widest, profile.height());
    return marchTetrahedra(distance, low - cell*Vector3(1.37, 1.41, 1.29), high + cell*Vector3(1.5, 1.5, 1.5), cell);
}

std::vector<MeridianPoint> meridianPoints(const TriangleMesh& mesh, double above)
{
    const std::vector<double> areas = mesh.vertexAreas();
    std::vector<MeridianPoint> points;
    for (std::size_t i = 0; i < areas.size(); ++i)
    {
        const Vector3& x = mesh.vertices[i];
        if (x.z > above) points.push_back({std::hypot(x.x, x.y), x.z, areas[i]});
    }
    return points;
}

}
