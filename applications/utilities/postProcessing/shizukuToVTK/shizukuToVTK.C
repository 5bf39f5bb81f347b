// SPDX-License-Identifier: GPL-3.0-or-later
// Converts a case to .vtp files and animations for ParaView: the liquid's particles, its surface, the solid particles.
//
//     VTK/liquid/liquid_<index>.vtp       particles: U [m/s], id, and every other field of <time>/liquid in its SI unit
//     VTK/surface/surface_<index>.vtp     mesh of meshSurface: normals, curvature [1/m], theta [degrees] of the wall where it is near, NaN elsewhere, body
//                                         (drops/BodyNumbers.H), and the particles' fields (meshes/FieldsAt.H)
//     VTK/solid/solid_<index>.vtp         solid particles, where they are at the time: normals out of the solid, patch (its number), theta [degrees]
//     VTK/walls/walls_<index>.vtp         analytic walls, where they are at the time, as meshes that look into the liquid: wall (its number); planes and cylinders end
//                                         beside the liquid of the first time
//     VTK/<name>.pvd, <name>.vtp.series   the animations
//
// With -parallel each part writes the particles that it has read, a share of the file, as a piece of liquid_<index>.pvtp; so it does with a surface that is
// in pieces.
//
// Coordinates are in metres; every file has the field data TimeValue [s] and particleSpacing [m]. <index> counts the case's
// times, whichever are selected. The animations keep what was converted before of times that are not selected now.

#include "AnalyticWalls.H"
#include "LiquidFields.H"
#include "SurfaceFields.H"

#include "caseFiles/DrawnSurface.H"
#include "caseFiles/LiquidFiles.H"
#include "caseFiles/SolidParticles.H"
#include "caseFiles/VectorField.H"
#include "core/arguments/runApplication.H"
#include "core/messages/Progress.H"
#include "core/time/Time.H"
#include "meshes/PlyFile.H"
#include "parallel/AllParts.H"
#include "parallel/ParallelRun.H"
#include "vtk/VtkSeries.H"
#include "wallMotions/WallMotions.H"

#include <algorithm>
#include <iostream>
#include <optional>

using namespace shizuku;

namespace
{

// The solid particles with the newest theta at or before the time; a new file only where that is another one, or where walls move.
class SolidConverter
{
public:
    explicit SolidConverter(const std::filesystem::path& casePath) : case_(casePath)
    {
        if (!haveSolidParticles(casePath)) return;
        solid_ = readSolidParticles(casePath);
        moves_ = !WallMotions::read(casePath).none();
    }

    void add(VtkSeries& series, const TimeFolder& time, int index, double spacing)
    {
        if (solid_.positions.empty()) return;
        const auto instance = findInstance(case_, time.value, "solid/theta");
        if (moves_) solid_ = readSolidParticles(case_, time.value);
        else if (series.times() > 0 && instance == instance_)
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
    bool moves_ = false;
    std::filesystem::path instance_;    // of the theta written last
};

// The place of a time among others: of all of the case, the same number whatever times are selected. Their number where it
// is none of them.
int indexOf(const TimeFolder& time, const std::vector<TimeFolder>& among)
{
    const auto same = [&](const TimeFolder& other) { return other.name == time.name; };
    return int(std::find_if(among.begin(), among.end(), same) - among.begin());
}

// Those of a surface in pieces that are a part's, by turns.
TriangleMesh ownPieces(const std::filesystem::path& file, const Communicator& parts)
{
    const std::vector<std::filesystem::path> all = piecesOfPvtp(file);
    std::vector<std::filesystem::path> own;
    for (std::size_t k = parts.part(); k < all.size(); k += parts.parts()) own.push_back(all[k]);
    return readPieces(own);
}

class Conversion
{
public:
    Conversion(const Arguments& args, const Communicator& parts)
    :
        parts_(parts), case_(args.casePath()), all_(timeFolders(case_)), times_(selectTimes(args)), spacing_(readSpacing(case_)),
        fields_(times_, args.found("fields") ? std::optional(args.getList("fields")) : std::nullopt),
        liquid_(case_, "liquid", vtkEncodingFrom(args.get("format"))), surface_(case_, "surface", vtkEncodingFrom(args.get("format"))),
        solid_(case_, "solid", vtkEncodingFrom(args.get("format"))), walls_(case_, "walls", vtkEncodingFrom(args.get("format"))),
        surfaceFields_(case_, spacing_, fields_, parts)
    {
        if (parts.part() > 0) return;
        solidConverter_.emplace(case_);
    }

    void run()
    {
        Progress progress("Converting to VTK");
        for (std::size_t i = 0; i < times_.size(); ++i)
        {
            std::cout << "Time = " << times_[i].name << '\n';
            const int index = indexOf(times_[i], all_);
            addLiquid(times_[i], index);
            addSurface(times_[i], index, int(i) % parts_.parts());
            inAllParts(parts_, [&]
            {
                if (parts_.part() == 0 && !analytic_) placeAnalyticWalls(times_[i]);
                if (solidConverter_) solidConverter_->add(solid_, times_[i], index, spacing_);
                if (analytic_) analytic_->add(walls_, times_[i].value, index, spacing_);
            });
            progress.update(double(i + 1)/times_.size());
        }
        inAllParts(parts_, [&] { finish(); });
    }

private:
    // Around the liquid of the first time that has some; not before.
    void placeAnalyticWalls(const TimeFolder& time)
    {
        if (!std::filesystem::exists(time.path/"liquid/positions")) return;
        const std::vector<Vector3> liquid = readLiquidPositions(time.path);
        if (!liquid.empty()) analytic_.emplace(case_, boundsOf(liquid));
    }

    void addLiquid(const TimeFolder& time, int index)
    {
        if (!std::filesystem::exists(time.path/"liquid/positions")) return;
        VtpContent content;
        inAllParts(parts_, [&]
        {
            std::size_t particles = 0;
            const auto share = [&](std::size_t n)
            {
                particles = n;
                const auto [first, end] = shareOf(parts_, n);
                return ElementRange{first, end};
            };
            content.points = readLiquidPositions(time.path, share);
            content.pointFields = fields_.read(time.path, particles, share);
        });
        liquid_.addPiece(time.value, index, std::move(content), spacing_, parts_);
    }

    // A surface that is one mesh is converted by one part. In pieces it keeps its lids at cyclic sides: those that are opposite are of other pieces.
    void addSurface(const TimeFolder& time, int index, int converter)
    {
        const auto mesh = liquidSurfaceFile(time.path), pieces = liquidSurfaceFile(time.path, "pvtp");
        const bool isOne = std::filesystem::exists(mesh);
        if (!isOne && !std::filesystem::exists(pieces)) return;
        surfaceFields_.start(time);
        VtpContent own;
        inAllParts(parts_, [&]
        {
            if (!isOne) own = surfaceFields_.of(ownPieces(pieces, parts_));
            else if (parts_.part() == converter) surface_.add(time.value, index, surfaceFields_.of(drawnSurface(readPly(mesh), case_)), spacing_);
            else surface_.addOther(time.value, index);
        });
        if (!isOne) surface_.addPiece(time.value, index, std::move(own), spacing_, parts_);
    }

    void finish() const
    {
        if (parts_.part() > 0) return;
        if (liquid_.times() + surface_.times() + solid_.times() + walls_.times() == 0)
        {
            throw FatalInputError
            (
                {case_.string(), 0}, "The selected times hold nothing to convert",
                "<time>/liquid, <time>/surface or constant/solid"
            );
        }
        std::vector<double> others;
        for (const TimeFolder& time : all_)
        {
            if (indexOf(time, times_) == int(times_.size())) others.push_back(time.value);
        }
        for (const VtkSeries* series : {&liquid_, &surface_, &solid_, &walls_})
        {
            series->finish(others);
            if (series->times() > 0) std::cout << "Written: " << series->pvdFile().string() << '\n';
        }
    }

    const Communicator& parts_;
    std::filesystem::path case_;
    std::vector<TimeFolder> all_, times_;
    double spacing_;
    LiquidFields fields_;
    VtkSeries liquid_, surface_, solid_, walls_;
    std::optional<SolidConverter> solidConverter_;      // of part 0
    std::optional<AnalyticWalls> analytic_;             // of part 0
    SurfaceFields surfaceFields_;
};

}

int main(int argc, char** argv)
{
    std::vector<Option> options = timeSelectionOptions();
    options.push_back({"fields", "LIST", "Convert these fields of the liquid, e.g. \"(U id)\" (default: all)", ""});
    options.push_back
    ({
        "format", "ascii|binary|appended",
        "Format of the files; appended is the smallest, but some builds of VTK 9.1 cannot read it",
        "binary"
    });
    options.push_back(parallelOption("shizukuToVTK"));
    const ApplicationInfo info{"shizukuToVTK", "Convert particles, solids and surfaces to VTK files for ParaView.", options};
    return runInParts(argc, argv, [&](const Communicator& parts)
    {
        return runApplication(argc, argv, info, [&](const Arguments& args) { Conversion(args, parts).run(); });
    });
}
