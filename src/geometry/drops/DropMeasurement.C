#include "geometry/drops/DropMeasurement.H"

#include "geometry/PointsInside.H"

#include <algorithm>
#include <numbers>

namespace shizuku
{

namespace
{

Plane planeOfWall(const std::filesystem::path& casePath, const CaseWalls& walls, const std::string& wall, double spacing)
{
    const auto plane = planeOf(walls, wall, spacing);
    if (plane) return *plane;
    throw FatalInputError
    (
        {(casePath/"constant/walls").string(), 0}, "The wall '" + wall + "' is no plane",
        "a wall of type plane, or a flat patch of solid particles"
    );
}

}

DropControls DropControls::read(const Dictionary& dict, const CaseWalls& walls)
{
    DropControls controls;
    if (dict.found("wall") || walls.names.size() != 1) controls.wall = dict.lookupChoice("wall", walls.names);
    else controls.wall = walls.names.front();
    if (dict.found("fitAbove"))
    {
        controls.limits.fitAbove = dict.lookupPositive("fitAbove", dimensions::none, true);
    }
    return controls;
}

DropMeasurement::DropMeasurement
(
    const std::filesystem::path& casePath, const DropControls& controls, CaseWalls walls, double spacing
)
:
    walls_(std::move(walls)), controls_(controls), spacing_(spacing),
    plane_(planeOfWall(casePath, walls_, controls.wall, spacing)), prescribed_(casePath, walls_, controls.wall)
{}

std::vector<DropRecord> DropMeasurement::measure
(
    const TriangleMesh& surface, const std::vector<Vector3>& particles, double time
)
{
    constexpr double smallest = 20;         // particles
    const std::vector<Drop> drops = separateDrops(surface, smallest*spacing_*spacing_*spacing_);
    std::vector<Vector3> centroids;
    for (const Drop& drop : drops) centroids.push_back(drop.surface.centroid());
    const std::vector<int> numbers = numbers_.assign(centroids);

    std::vector<DropRecord> records;
    for (std::size_t i = 0; i < drops.size(); ++i)
    {
        records.push_back(measureDrop(drops[i], centroids[i], particles, time));
        DropRecord& record = records.back();
        record.drop = numbers[i];
        record.firstDrift = record.volume/firstVolumes_.try_emplace(record.drop, record.volume).first->second - 1;
    }
    std::sort(records.begin(), records.end(), [](const auto& a, const auto& b) { return a.drop < b.drop; });
    return records;
}

DropRecord DropMeasurement::measureDrop
(
    const Drop& drop, const Vector3& centroid, const std::vector<Vector3>& particles, double time
) const
{
    DropRecord record;
    record.time = time;
    record.shape = measureContactAngle(drop.surface, plane_, spacing_, controls_.limits);
    record.volume = drop.volume;
    const std::vector<int> winding = windingNumbers(drop.surface, particles);
    record.particles = std::count_if(winding.begin(), winding.end(), [](int w) { return w > 0; });
    record.particleDrift = drop.volume/(record.particles*spacing_*spacing_*spacing_) - 1;
    record.centroid = centroid;
    const double footprint = std::sqrt(record.shape.coveredArea/std::numbers::pi);
    record.prescribed = prescribed_.below(centroid, footprint, plane_);
    return record;
}

}
