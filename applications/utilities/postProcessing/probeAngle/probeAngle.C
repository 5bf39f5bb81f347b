// Measures the apparent contact angle of every separate drop on a plane wall, from the meshes of meshSurface.

#include "DropNumbers.H"
#include "DropTable.H"
#include "PrescribedAngle.H"

#include "core/arguments/runApplication.H"
#include "core/time/Time.H"
#include "geometry/Drops.H"
#include "geometry/LiquidFiles.H"
#include "geometry/MeshTopology.H"
#include "geometry/PlyFile.H"
#include "geometry/PointsInside.H"
#include "geometry/WallPlane.H"

#include <algorithm>
#include <iostream>
#include <map>
#include <numbers>

using namespace shizuku;

namespace
{

// system/probeAngleDict:   wall floor;   fitAbove 1.25;     Both may be left out: a case with one wall needs no name.
struct Controls
{
    std::string wall;
    ContactAngleLimits limits;
};

Controls readControls(const std::filesystem::path& casePath, const CaseWalls& walls)
{
    const auto file = casePath/"system/probeAngleDict";
    const Dictionary dict = std::filesystem::exists(file) ? Dictionary::read(file) : Dictionary();
    Controls controls;
    if (dict.found("wall") || walls.names.size() != 1) controls.wall = dict.lookupChoice("wall", walls.names);
    else controls.wall = walls.names.front();
    if (dict.found("fitAbove"))
    {
        controls.limits.fitAbove = dict.lookupPositive("fitAbove", dimensions::none, true);
    }
    dict.refuseUnused();
    return controls;
}

// The drops of a time; pieces below twenty particles are splashes, no drops.
std::vector<Drop> readDrops(const std::filesystem::path& file, double spacing)
{
    constexpr double smallest = 20;
    const TriangleMesh mesh = readPly(file);
    if (!findDefects(mesh).closed() || mesh.volume() < 0)
    {
        throw FatalInputError
        (
            {file.string(), 0}, "The mesh is open, or its faces look inward", "a closed mesh of meshSurface"
        );
    }
    return separateDrops(mesh, smallest*spacing*spacing*spacing);
}

class Measurement
{
public:
    Measurement(const std::filesystem::path& casePath, const CaseWalls& walls, const Controls& controls)
    : controls_(controls), spacing_(readSpacing(casePath)), plane_(wallPlane(casePath, walls)),
      prescribed_(casePath, walls, controls.wall)
    {}

    std::vector<DropRecord> measure(const TimeFolder& time)
    {
        const std::vector<Drop> drops = readDrops(liquidSurfaceFile(time.path), spacing_);
        const std::vector<Vector3> particles = readLiquidPositions(time.path);
        std::vector<Vector3> centroids;
        for (const Drop& drop : drops) centroids.push_back(drop.surface.centroid());
        const std::vector<int> numbers = numbers_.assign(centroids);

        std::vector<DropRecord> records;
        for (std::size_t i = 0; i < drops.size(); ++i)
        {
            records.push_back(measure(drops[i], centroids[i], particles, time.value));
            DropRecord& record = records.back();
            record.drop = numbers[i];
            record.firstDrift = record.volume/firstVolumes_.try_emplace(record.drop, record.volume).first->second - 1;
        }
        std::sort(records.begin(), records.end(), [](const auto& a, const auto& b) { return a.drop < b.drop; });
        return records;
    }

private:
    Plane wallPlane(const std::filesystem::path& casePath, const CaseWalls& walls) const
    {
        const auto plane = planeOf(walls, controls_.wall, spacing_);
        if (plane) return *plane;
        throw FatalInputError
        (
            {(casePath/"constant/walls").string(), 0}, "The wall '" + controls_.wall + "' is no plane",
            "a wall of type plane, or a flat patch of solid particles"
        );
    }

    DropRecord measure
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
        record.prescribed = prescribed_.below(centroid, footprint, plane_, time);
        return record;
    }

    Controls controls_;
    double spacing_;                        // m
    Plane plane_;
    PrescribedAngle prescribed_;
    DropNumbers numbers_;
    std::map<int, double> firstVolumes_;    // m3, by the drop's number
};

void probeAngle(const Arguments& args)
{
    std::vector<TimeFolder> times = selectTimes(args);
    std::erase_if(times, [](const TimeFolder& time) { return !std::filesystem::exists(liquidSurfaceFile(time.path)); });
    if (times.empty())
    {
        throw FatalInputError
        (
            {args.casePath().string(), 0}, "None of the selected times has a surface mesh",
            "<time>/surface/liquid.ply: run meshSurface before"
        );
    }

    const CaseWalls walls = readCaseWalls(args.casePath());
    const Controls controls = readControls(args.casePath(), walls);
    Measurement measurement(args.casePath(), walls, controls);
    CsvFile table = dropTable(args.casePath()/"postProcessing/probeAngle"/times.front().name/"angle.csv");
    for (const TimeFolder& time : times)
    {
        const std::vector<DropRecord> records = measurement.measure(time);
        std::cout << "Time = " << time.name << ": " << records.size() << (records.size() == 1 ? " drop\n" : " drops\n");
        for (const DropRecord& record : records)
        {
            addRow(table, record);
            if (&time == &times.back()) std::cout << '\n' << report(record, controls.wall);
        }
    }
    table.write();
    std::cout << "\nWritten: " << table.file().string() << "\n";
}

}

int main(int argc, char** argv)
{
    return runApplication
    (
        argc, argv,
        {
            "probeAngle", "Measures contact angle, contact radius, height and volume of every drop on a plane wall.",
            timeSelectionOptions()
        },
        probeAngle
    );
}
