// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the apparent contact angle of every separate drop on a wall, from the meshes of meshSurface.

#include "caseFiles/LiquidFiles.H"
#include "core/arguments/runApplication.H"
#include "core/messages/Progress.H"
#include "core/time/Time.H"
#include "drops/DropMeasurement.H"
#include "meshes/MeshTopology.H"
#include "meshes/PlyFile.H"
#include "parallel/AllParts.H"
#include "parallel/ParallelRun.H"

#include <algorithm>
#include <iostream>
#include <sstream>

using namespace shizuku;

namespace
{

// system/probeAngleDict, which may be absent.
DropControls readControls(const std::filesystem::path& casePath, const CaseWalls& walls)
{
    const auto file = casePath/"system/probeAngleDict";
    const Dictionary dict = std::filesystem::exists(file) ? Dictionary::read(file) : Dictionary();
    const DropControls controls = DropControls::read(dict, walls);
    dict.refuseUnused();
    return controls;
}

TriangleMesh readSurface(const std::filesystem::path& file)
{
    TriangleMesh mesh = readPly(file);
    if (findDefects(mesh).closed() && mesh.volume() >= 0) return mesh;
    throw FatalInputError
    (
        {file.string(), 0}, "The mesh is open, or its faces look inward", "a closed mesh of meshSurface"
    );
}

// What a part found at its time of a round: the drops by what their numbers go by, and what of them is written and printed.
struct FoundDrop
{
    Vector3 centroid;
    double volume;
};

class Probe
{
public:
    Probe(const Arguments& args, const Communicator& parts)
    :
        parts_(parts), times_(selectTimesWith(args, holdsSurface, "a surface mesh", "<time>/surface/liquid.ply: run meshSurface before")),
        walls_(readCaseWalls(args.casePath())), controls_(readControls(args.casePath(), walls_)),
        measurement_(args.casePath(), controls_, walls_, readSpacing(args.casePath())),
        methods_(args.found("methods")), table_(dropTable(args.casePath()/"postProcessing/probeAngle"/times_.front().name/"angle.csv"))
    {}

    // The parts take a time each, one round after another.
    void measure()
    {
        Progress progress("Measuring");
        for (std::size_t first = 0; first < times_.size(); first += parts_.parts())
        {
            progress.update(double(first)/times_.size());
            measureRound(first);
        }
        if (parts_.part() == 0) table_.write();
        std::cout << "\nWritten: " << table_.file().string() << "\n";
    }

private:
    static bool holdsSurface(const TimeFolder& time) { return std::filesystem::exists(liquidSurfaceFile(time.path)); }

    void measureRound(std::size_t first)
    {
        const std::size_t own = first + parts_.part();
        std::vector<DropRecord> records;
        inAllParts(parts_, [&] { if (own < times_.size()) records = drops(times_[own]); });

        // The numbers of drops go on from time to time.
        std::vector<FoundDrop> found;
        for (const DropRecord& record : records) found.push_back({record.centroid, record.volume});
        const std::vector<Bytes> all = parts_.exchange(std::vector<Bytes>(parts_.parts(), bytesOf(found)));
        for (std::size_t time = first; time < std::min(first + parts_.parts(), times_.size()); ++time)
        {
            if (time == own) measurement_.number(records);
            else numberOthers(all[time - first]);
        }

        for (const DropRecord& record : records) addRow(table_, record);
        const std::string rows = table_.takeRows();
        for (const std::string& of : gatherTexts(parts_, rows)) table_.addRows(of);
        for (const std::string& of : gatherTexts(parts_, own < times_.size() ? textOf(times_[own], records) : "")) std::cout << of << std::flush;
    }

    std::vector<DropRecord> drops(const TimeFolder& time)
    {
        measurement_.readCase(time.value);
        const std::vector<Drop> drops = measurement_.dropsOf(readSurface(liquidSurfaceFile(time.path)));
        return measurement_.measure(drops, particlesInside(drops, readLiquidPositions(time.path), Alone()), time.value, heldAngles(time));
    }

    // A start has none: no step has been made that would know of lines.
    HeldAngles heldAngles(const TimeFolder& time) const
    {
        const auto file = time.path/"liquid/contactLineAngle";
        if (!measurement_.hasLaw() || !std::filesystem::exists(file)) return {};
        const std::vector<Vector3> positions = readLiquidPositions(time.path);
        const FieldData angles = readField(file, FieldType::scalar, dimensions::none, long(positions.size()));
        std::vector<double> radians(positions.size());
        for (std::size_t i = 0; i < radians.size(); ++i) radians[i] = angles(i);
        return HeldAngles::of(positions, radians);
    }

    void numberOthers(const Bytes& bytes)
    {
        std::vector<FoundDrop> found;
        appendTo(found, bytes);
        std::vector<DropRecord> records(found.size());
        for (std::size_t k = 0; k < found.size(); ++k)
        {
            records[k].centroid = found[k].centroid;
            records[k].volume = found[k].volume;
        }
        measurement_.number(records);
    }

    std::string textOf(const TimeFolder& time, const std::vector<DropRecord>& records) const
    {
        std::ostringstream text;
        text << "Time = " << time.name << ": " << records.size() << (records.size() == 1 ? " drop\n" : " drops\n");
        if (&time != &times_.back()) return text.str();
        for (const DropRecord& record : records) text << '\n' << report(record, controls_.wall, methods_);
        return text.str();
    }

    const Communicator& parts_;
    std::vector<TimeFolder> times_;
    CaseWalls walls_;
    DropControls controls_;
    DropMeasurement measurement_;
    bool methods_;
    CsvFile table_;
};

}

int main(int argc, char** argv)
{
    std::vector<Option> options = timeSelectionOptions();
    options.push_back({"methods", "", "Print the angle by each method: profile, sphere, tangents", ""});
    options.push_back(parallelOption("probeAngle"));
    const ApplicationInfo info
    {
        "probeAngle", "Measure contact angle, contact radius, height and volume of each drop on a wall.", options
    };
    return runInParts(argc, argv, [&](const Communicator& parts)
    {
        return runApplication(argc, argv, info, [&](const Arguments& args) { Probe(args, parts).measure(); });
    });
}
