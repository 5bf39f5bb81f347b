// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/WettedSurface.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace shizuku
{

namespace
{

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// The planes that bound a box; any other wall itself.
std::vector<AnalyticSurface> smoothParts(const AnalyticSurface& wall)
{
    if (wall.type != AnalyticSurface::Type::box) return {wall};
    std::vector<AnalyticSurface> planes;
    for (const Vector3& n : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)})
    {
        AnalyticSurface plane;
        plane.name = wall.name;
        plane.point = wall.min;
        plane.direction = n;
        planes.push_back(plane);
        plane.point = wall.max;
        plane.direction = -n;
        planes.push_back(plane);
    }
    return planes;
}

// The largest extent of points over the directions at right angles to n. Directions stand 2 degrees apart, so that it
// may be short by 1 - cos(1 degree) = 1.5e-4.
double extentAlong(const std::vector<Vector3>& points, const Vector3& n)
{
    constexpr int directions = 90;
    const Vector3 u = perpendicular(n), v = cross(n, u);
    double most = 0;
    for (int k = 0; k < directions; ++k)
    {
        const double angle = std::numbers::pi*k/directions;
        const Vector3 direction = std::cos(angle)*u + std::sin(angle)*v;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vector3& p : points)
        {
            const double place = dot(p, direction);
            low = std::min(low, place);
            high = std::max(high, place);
        }
        most = std::max(most, high - low);
    }
    return most;
}

}

WettedSurface::WettedSurface(const std::filesystem::path& casePath, double spacing) : spacing_(spacing)
{
    for (const AnalyticSurface& wall : readAnalyticSurfaces(Dictionary::read(casePath/"constant/walls")))
    {
        for (const AnalyticSurface& part : smoothParts(wall)) analytic_.push_back(part);
    }
    for (const AnalyticSurface& wall : analytic_) names_.push_back(wall.name);
    if (!haveSolidParticles(casePath)) return;
    solid_ = readSolidParticles(casePath);
    if (!solid_.positions.empty()) nearest_ = std::make_unique<NearestPoint>(solid_.positions);
    names_.insert(names_.end(), solid_.patches.begin(), solid_.patches.end());
}

std::vector<WettedSurface::Contact> WettedSurface::find(const TriangleMesh& mesh) const
{
    std::vector<Contact> contacts;
    contacts.reserve(mesh.faces.size());
    for (const auto& [i, j, k] : mesh.faces)
    {
        const Vector3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        contacts.push_back(contactOf((a + b + c)/3, 0.5*cross(b - a, c - a)));
    }
    return contacts;
}

WettedSurface::Contact WettedSurface::contactOf(const Vector3& centre, const Vector3& area) const
{
    constexpr double reach = 0.75;                  // spacings
    Contact contact;
    contact.area = length(area);
    double closest = reach*spacing_;
    const auto consider = [&](int wall, long solid, double distance, const Vector3& normal)
    {
        const double projected = -dot(area, normal);
        if (std::abs(distance) > closest || projected < 0.5*length(area)) return;
        closest = std::abs(distance);
        contact = {wall, solid, projected, normal};
    };
    for (std::size_t a = 0; a < analytic_.size(); ++a)
    {
        consider(int(a), -1, analytic_[a].signedDistance(centre), analytic_[a].normal(centre));
    }
    if (!nearest_) return contact;
    // Solid particles lie half a spacing inside of the solid; beside the border of their layer is no wall.
    const auto k = nearest_->within(centre, std::hypot(0.5 + reach, 1)*spacing_);
    if (!k) return contact;
    const Vector3 r = centre - solid_.positions[*k], &n = solid_.normals[*k];
    const double height = dot(r, n);
    if (squaredLength(r) - height*height < spacing_*spacing_)
    {
        consider(int(analytic_.size()) + solid_.patch[*k], long(*k), height - 0.5*spacing_, n);
    }
    return contact;
}

Spread measureSpread(const TriangleMesh& mesh, const std::vector<WettedSurface::Contact>& contacts, int wall)
{
    Spread spread;
    Vector3 normal;
    std::vector<Vector3> places;
    for (std::size_t f = 0; f < contacts.size(); ++f)
    {
        if (contacts[f].wall != wall) continue;
        spread.wettedArea += contacts[f].area;
        normal += contacts[f].area*contacts[f].normal;
        for (const int vertex : mesh.faces[f]) places.push_back(mesh.vertices[vertex]);
    }
    if (!(length(normal) > 0))
    {
        spread.normal = {none, none, none};
        spread.liquidExtent = spread.height = none;
        return spread;
    }
    spread.normal = normalized(normal);
    spread.wettedDiameter = 2*std::sqrt(spread.wettedArea/std::numbers::pi);
    spread.wettedExtent = extentAlong(places, spread.normal);
    spread.liquidExtent = extentAlong(mesh.vertices, spread.normal);
    double base = 0, top = -std::numeric_limits<double>::infinity();
    for (const Vector3& p : places) base += dot(p, spread.normal)/double(places.size());
    for (const Vector3& p : mesh.vertices) top = std::max(top, dot(p, spread.normal));
    spread.height = top - base;
    return spread;
}

}
