// SPDX-License-Identifier: GPL-3.0-or-later
// Converts a case to .vtp files and animations for ParaView: the liquid's particles, its surface, the solid particles.
//
//     VTK/liquid/liquid_<index>.vtp       particles: U [m/s], id, and every other field of <time>/liquid in its SI unit
//     VTK/surface/surface_<index>.vtp     mesh of meshSurface, with normals
//     VTK/solid/solid_<index>.vtp         solid particles: normals out of the solid, patch (its number), theta [degrees]
//     VTK/<name>.pvd, <name>.vtp.series   the animations
//
// Coordinates are in metres; every file has the field data TimeValue [s] and particleSpacing [m]. <index> counts the case's
// times, whichever are selected. The animations keep what was converted before of times that are not selected now.

#include "LiquidFields.H"

#include "caseFiles/LiquidFiles.H"
#include "caseFiles/SolidParticles.H"
#include "caseFiles/VectorField.H"
#include "core/arguments/runApplication.H"
#include "core/messages/Progress.H"
#include "core/time/Time.H"
#include "meshes/PlyFile.H"
#include "vtk/VtkSeries.H"

#include <algorithm>
#include <iostream>

using namespace shizuku;

namespace
{

// The solid particles with the newest theta at or before the time; a new file only where that is another one.
class SolidConverter
{
public:
    explicit SolidConverter(const std::filesystem::path& casePath) : case_(casePath)
    {
        if (haveSolidParticles(casePath)) solid_ = readSolidParticles(casePath);
    }

    void add(VtkSeries& series, const TimeFolder& time, int index, double spacing)
    {
        if (solid_.positions.empty()) return;
        const auto instance = findInstance(case_, time.value, "solid/theta");
        if (series.times() > 0 && instance == instance_)
        {
            series.repeat(time.value);
            return;
        }
        instance_ = instance;
        VtpContent content;
        content.points = solid_.positions;
        content.pointFields.push_back(toField("normals", dimensions::none, solid_.normals));
        const std::vector<double> patch(solid_.patch.begin(), solid_.patch.end());
        content.pointFields.push_back({"patch", FieldType::label, dimensions::none, false, patch});
        if (!instance.empty())
        {
            content.pointFields.push_back
            (
                readField(instance/"solid/theta", FieldType::scalar, dimensions::none, long(solid_.positions.size()))
            );
        }
        series.add(time.value, index, std::move(content), spacing);
    }

private:
    std::filesystem::path case_;
    SolidParticles solid_;
    std::filesystem::path instance_;    // of the theta written last
};

// The place of a time among others: of all of the case, the same number whatever times are selected. Their number where it
// is none of them.
int indexOf(const TimeFolder& time, const std::vector<TimeFolder>& among)
{
    const auto same = [&](const TimeFolder& other) { return other.name == time.name; };
    return int(std::find_if(among.begin(), among.end(), same) - among.begin());
}

void convert(const Arguments& args)
{
    const std::vector<TimeFolder> all = timeFolders(args.casePath()), times = selectTimes(args);
    const double spacing = readSpacing(args.casePath());
    const VtkEncoding encoding = vtkEncodingFrom(args.get("format"));
    std::optional<std::vector<std::string>> wanted;
    if (args.found("fields")) wanted = args.getList("fields");
    const LiquidFields fields(times, wanted);

    VtkSeries liquid(args.casePath(), "liquid", encoding);
    VtkSeries surface(args.casePath(), "surface", encoding);
    VtkSeries solid(args.casePath(), "solid", encoding);
    SolidConverter solidConverter(args.casePath());

    Progress progress("Converting to VTK");
    for (std::size_t i = 0; i < times.size(); ++i)
    {
        const TimeFolder& time = times[i];
        const int index = indexOf(time, all);
        std::cout << "Time = " << time.name << '\n';
        if (std::filesystem::exists(time.path/"liquid/positions"))
        {
            VtpContent content;
            content.points = readLiquidPositions(time.path);
            content.pointFields = fields.read(time.path, content.points.size());
            liquid.add(time.value, index, std::move(content), spacing);
        }
        if (std::filesystem::exists(liquidSurfaceFile(time.path)))
        {
            surface.add(time.value, index, vtpOf(readPly(liquidSurfaceFile(time.path))), spacing);
        }
        solidConverter.add(solid, time, index, spacing);
        progress.update(double(i + 1)/times.size());
    }

    if (liquid.times() + surface.times() + solid.times() == 0)
    {
        throw FatalInputError
        (
            {args.casePath().string(), 0}, "The selected times hold nothing to convert",
            "<time>/liquid, <time>/surface or constant/solid"
        );
    }
    std::vector<double> others;
    for (const TimeFolder& time : all)
    {
        if (indexOf(time, times) == int(times.size())) others.push_back(time.value);
    }
    for (const VtkSeries* series : {&liquid, &surface, &solid})
    {
        series->finish(others);
        if (series->times() > 0) std::cout << "Written: " << series->pvdFile().string() << '\n';
    }
}

}

int main(int argc, char** argv)
{
    std::vector<Option> options = timeSelectionOptions();
    options.push_back({"fields", "LIST", "fields of the liquid to be converted, e.g. \"(U id)\"; default: all", ""});
    options.push_back
    ({
        "format", "ascii|binary|appended",
        "how the numbers stand in the files; appended is the smallest, but not every VTK 9.1 reads it",
        "binary"
    });
    return runApplication
    (
        argc, argv,
        {"shizukuToVTK", "Converts particles, solids and surfaces to VTK files for ParaView.", options}, convert
    );
}
