// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the apparent contact angle of every separate drop on a wall, from the meshes of meshSurface.

#include "caseFiles/LiquidFiles.H"
#include "core/arguments/runApplication.H"
#include "core/messages/Progress.H"
#include "core/time/Time.H"
#include "drops/DropMeasurement.H"
#include "meshes/MeshTopology.H"
#include "meshes/PlyFile.H"

#include <iostream>

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

void probeAngle(const Arguments& args)
{
    const auto holds = [](const TimeFolder& time) { return std::filesystem::exists(liquidSurfaceFile(time.path)); };
    const std::vector<TimeFolder> times =
        selectTimesWith(args, holds, "a surface mesh", "<time>/surface/liquid.ply: run meshSurface before");

    const CaseWalls walls = readCaseWalls(args.casePath());
    const DropControls controls = readControls(args.casePath(), walls);
    DropMeasurement measurement(args.casePath(), controls, walls, readSpacing(args.casePath()));
    CsvFile table = dropTable(args.casePath()/"postProcessing/probeAngle"/times.front().name/"angle.csv");
    Progress progress("Measuring");
    for (const TimeFolder& time : times)
    {
        progress.update(double(&time - times.data())/times.size());
        measurement.readCase(time.value);
        const std::vector<DropRecord> records = measurement.measure
        (
            readSurface(liquidSurfaceFile(time.path)), readLiquidPositions(time.path), time.value
        );
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
            "probeAngle", "Measures contact angles, contact radius, height and volume of every drop on a wall.",
            timeSelectionOptions()
        },
        probeAngle
    );
}
