// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/WettedSurface.H"

#include "device/HostThreads.H"

#include <algorithm>
#include <array>
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

std::vector<AnalyticSurface> smoothPartsOf(const std::filesystem::path& casePath)
{
    std::vector<AnalyticSurface> parts;
    for (const AnalyticSurface& wall : readAnalyticSurfaces(Dictionary::read(casePath/"constant/walls")))
    {
        for (const AnalyticSurface& part : smoothParts(wall)) parts.push_back(part);
    }
    return parts;
}

struct Wetted
{
    double area = 0, places = 0;
    Vector3 normal;

    void add(const Wetted& other)
    {
        area += other.area;
        places += other.places;
        normal += other.normal;
    }
};

// Where points lie along the directions at right angles to n, from the lowest to the highest. Directions stand 2 degrees apart, so that the largest extent
// may be short by 1 - cos(1 degree) = 1.5e-4.
class Extents
{
public:
    Extents()
    {
        low_.fill(std::numeric_limits<double>::infinity());
        high_.fill(-std::numeric_limits<double>::infinity());
    }

    Extents(const std::vector<Vector3>& points, const Vector3& n) : Extents()
    {
        constexpr std::size_t share = 1 << 15;
        const Vector3 u = perpendicular(n), v = cross(n, u);
        std::vector<Extents> extents((points.size() + share - 1)/share);
        forEachPart(extents.size(), [&](std::size_t part)
        {
            const std::size_t end = std::min(points.size(), (part + 1)*share);
            for (int k = 0; k < directions; ++k)
            {
                const double angle = std::numbers::pi*k/directions;
                const Vector3 direction = std::cos(angle)*u + std::sin(angle)*v;
                double low = extents[part].low_[k], high = extents[part].high_[k];
                for (std::size_t i = part*share; i < end; ++i)
                {
                    const double place = dot(points[i], direction);
                    low = std::min(low, place);
                    high = std::max(high, place);
                }
                extents[part].low_[k] = low;
                extents[part].high_[k] = high;
            }
        });
        for (const Extents& each : extents) add(each);
    }

    void add(const Extents& other)
    {
        for (int k = 0; k < directions; ++k)
        {
            low_[k] = std::min(low_[k], other.low_[k]);
            high_[k] = std::max(high_[k], other.high_[k]);
        }
    }

    double largest() const
    {
        double most = 0;
        for (int k = 0; k < directions; ++k) most = std::max(most, high_[k] - low_[k]);
        return most;
    }

private:
    static constexpr int directions = 90;
    std::array<double, directions> low_, high_;
};

// Sizes along the mean normal and across it, of what is wetted and of all.
struct Sizes
{
    Extents wetted, all;
    double base = 0, top = -std::numeric_limits<double>::infinity();

    void add(const Sizes& other)
    {
        wetted.add(other.wetted);
        all.add(other.all);
        base += other.base;
        top = std::max(top, other.top);
    }
};

}

std::vector<std::string> WettedSurface::wallsOf(const std::filesystem::path& casePath)
{
    std::vector<std::string> names;
    for (const AnalyticSurface& part : smoothPartsOf(casePath)) names.push_back(part.name);
    if (!haveSolidParticles(casePath)) return names;
    for (const std::string& patch : readSolidPatches(casePath)) names.push_back(patch);
    return names;
}

WettedSurface::WettedSurface(const std::filesystem::path& casePath, double spacing) : spacing_(spacing), analytic_(smoothPartsOf(casePath))
{
    if (!haveSolidParticles(casePath)) return;
    solid_ = readSolidParticles(casePath);
    if (!solid_.positions.empty()) nearest_ = std::make_unique<NearestPoint>(solid_.positions);
}

std::vector<WettedSurface::Contact> WettedSurface::find(const TriangleMesh& mesh) const
{
    std::vector<Contact> contacts(mesh.faces.size());
    forEachInParallel(contacts.size(), [&](std::size_t f)
    {
        const auto& [i, j, k] = mesh.faces[f];
        const Vector3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
        contacts[f] = contactOf((a + b + c)/3, 0.5*cross(b - a, c - a));
    });
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

Spread measureSpread(const TriangleMesh& mesh, const std::vector<WettedSurface::Contact>& contacts, int wall, const Communicator& parts)
{
    Wetted wetted;
    std::vector<Vector3> places;
    for (std::size_t f = 0; f < contacts.size(); ++f)
    {
        if (contacts[f].wall != wall) continue;
        wetted.add({contacts[f].area, 3, contacts[f].area*contacts[f].normal});
        for (const int vertex : mesh.faces[f]) places.push_back(mesh.vertices[vertex]);
    }
    wetted = parts.fold(wetted);
    Spread spread;
    spread.wettedArea = wetted.area;
    if (!(length(wetted.normal) > 0))
    {
        spread.normal = {none, none, none};
        spread.liquidExtent = spread.height = none;
        return spread;
    }
    spread.normal = normalized(wetted.normal);
    spread.wettedDiameter = 2*std::sqrt(spread.wettedArea/std::numbers::pi);
    Sizes sizes{Extents(places, spread.normal), Extents(mesh.vertices, spread.normal)};
    for (const Vector3& p : places) sizes.base += dot(p, spread.normal)/wetted.places;
    for (const Vector3& p : mesh.vertices) sizes.top = std::max(sizes.top, dot(p, spread.normal));
    sizes = parts.fold(sizes);
    spread.wettedExtent = sizes.wetted.largest();
    spread.liquidExtent = sizes.all.largest();
    spread.height = sizes.top - sizes.base;
    return spread;
}

}
