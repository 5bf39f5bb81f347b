// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/PlanarLattice.H"

#include "sampling/OrderedPlacing.H"

#include <algorithm>
#include <limits>

namespace shizuku
{

namespace
{

constexpr double flatness = 1e-3;           // deviation from the plane, in spacings
constexpr double flatCosine = 0.99996;      // of half a degree
constexpr double smallestArea = 25;         // in squared spacings
constexpr double margin = 0.45;             // of the first row, in spacings: no corner is left without a particle
constexpr double smallestGap = 0.75;        // in spacings, to particles of other regions

using Region = std::vector<int>;            // faces

std::vector<Region> flatRegions(const SurfaceGeometry& surface, double spacing)
{
    std::vector<Region> regions;
    std::vector<bool> taken(surface.faces(), false);
    for (int seed = 0; seed < surface.faces(); ++seed)
    {
        if (taken[seed]) continue;
        const Vector3 normal = surface.faceNormal(seed);
        const Vector3 origin = surface.corners(seed)[0];
        const auto belongs = [&](int face)
        {
            const auto corners = surface.corners(face);
            return
                surface.surface().patch[face] == surface.surface().patch[seed]
             && dot(surface.faceNormal(face), normal) > flatCosine
             && std::all_of(corners.begin(), corners.end(), [&](const Vector3& corner)
                {
                    return std::abs(dot(corner - origin, normal)) < flatness*spacing;
                });
        };
        Region region{seed};
        taken[seed] = true;
        double area = 0;
        for (std::size_t i = 0; i < region.size(); ++i)
        {
            area += surface.area(region[i]);
            for (int k = 0; k < 3; ++k)
            {
                const int next = surface.neighbour(region[i], k);
                if (next >= 0 && !taken[next] && belongs(next))
                {
                    taken[next] = true;
                    region.push_back(next);
                }
            }
        }
        if (area >= smallestArea*spacing*spacing) regions.push_back(region);
    }
    return regions;
}

// Coordinates in the plane of a region: u along its longest border edge, v across.
class PlaneFrame
{
public:
    PlaneFrame(const SurfaceGeometry& surface, const Region& region)
    {
        const Vector3 normal = surface.faceNormal(region.front());
        std::vector<int> sorted = region;
        std::sort(sorted.begin(), sorted.end());
        double longest = 0;
        for (int face : region)
        {
            const auto corners = surface.corners(face);
            for (int k = 0; k < 3; ++k)
            {
                if (std::binary_search(sorted.begin(), sorted.end(), surface.neighbour(face, k))) continue;
                const Vector3 edge = corners[(k + 1) % 3] - corners[k];
                if (length(edge) > longest*(1 + 1e-9))
                {
                    longest = length(edge);
                    u = normalized(edge);
                }
            }
        }
        v = cross(normal, u);
        for (int face : region)
        {
            for (const Vector3& corner : surface.corners(face))
            {
                low[0] = std::min(low[0], dot(corner, u));
                low[1] = std::min(low[1], dot(corner, v));
                high[0] = std::max(high[0], dot(corner, u));
                high[1] = std::max(high[1], dot(corner, v));
            }
        }
        height = dot(surface.corners(region.front())[0], normal)*normal;
    }

    Vector3 at(double a, double b) const { return height + a*u + b*v; }

    Vector3 u, v, height;
    double low[2] = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    double high[2] = {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
};

bool inTriangle(const std::array<Vector3, 3>& corners, const Vector3& normal, const Vector3& x)
{
    for (int k = 0; k < 3; ++k)
    {
        const Vector3 edge = corners[(k + 1) % 3] - corners[k];
        // The edge belongs to both of its triangles; the gap to the first particle keeps the second one out.
        if (dot(cross(edge, x - corners[k]), normal) < -1e-9*squaredLength(edge)) return false;
    }
    return true;
}

// Rows along u with a margin from the region's ends; odd rows are shifted by half a column.
class Lattice
{
public:
    Lattice(const PlaneFrame& frame, double spacing)
    :
        frame_(frame),
        du_(fit(frame.high[0] - frame.low[0], spacing)),
        dv_(fit(frame.high[1] - frame.low[1] - 2*margin*spacing, spacing*std::sqrt(0.75))),
        firstV_(frame.low[1] + margin*spacing)
    {}

    template<class Visit>
    void forEachPointIn(const std::array<Vector3, 3>& corners, const Vector3& normal, Visit&& visit) const
    {
        double low[2] = {frame_.high[0], frame_.high[1]}, high[2] = {frame_.low[0], frame_.low[1]};
        for (const Vector3& corner : corners)
        {
            low[0] = std::min(low[0], dot(corner, frame_.u));
            low[1] = std::min(low[1], dot(corner, frame_.v));
            high[0] = std::max(high[0], dot(corner, frame_.u));
            high[1] = std::max(high[1], dot(corner, frame_.v));
        }
        const long firstRow = std::lround(std::floor((low[1] - firstV_)/dv_));
        const long lastRow = std::lround(std::ceil((high[1] - firstV_)/dv_));
        for (long row = firstRow; row <= lastRow; ++row)
        {
            const double firstU = frame_.low[0] + (row % 2 == 0 ? 0.25 : 0.75)*du_;
            const long firstColumn = std::lround(std::floor((low[0] - firstU)/du_));
            const long lastColumn = std::lround(std::ceil((high[0] - firstU)/du_));
            for (long column = firstColumn; column <= lastColumn; ++column)
            {
                const Vector3 x = frame_.at(firstU + column*du_, firstV_ + row*dv_);
                if (inTriangle(corners, normal, x)) visit(x);
            }
        }
    }

private:
    // `step`, changed so that it fits into `extent` a whole number of times.
    static double fit(double extent, double step) { return extent/std::max(1.0, std::round(extent/step)); }

    const PlaneFrame& frame_;
    double du_, dv_, firstV_;
};

}

void addPlanarLattices(ParticleLayer& layer)
{
    constexpr std::size_t together = 1 << 17;       // places that threads share
    const SurfaceGeometry& surface = layer.surface();
    const double gap = smallestGap*layer.spacing();
    PointGrid grid = layer.grid(gap);
    for (const Region& region : flatRegions(surface, layer.spacing()))
    {
        const PlaneFrame frame(surface, region);
        const Lattice lattice(frame, layer.spacing());
        std::vector<SurfacePoint> places;
        const auto addPlaces = [&]
        {
            addWhereRoomIs(layer, grid, gap, places, true);
            places.clear();
        };
        for (int face : region)
        {
            lattice.forEachPointIn(surface.corners(face), surface.faceNormal(face), [&](const Vector3& x)
            {
                places.push_back({face, x});
                if (places.size() == together) addPlaces();
            });
        }
        addPlaces();
    }
}

}
