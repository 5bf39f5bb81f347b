// SPDX-License-Identifier: GPL-3.0-or-later
// exportSurface: the meshes of meshSurface as a numbered series, with the liquid's velocities, for Blender and other programs for pictures.
//
//     export/liquid_<index>.ply, .glb, .vdb       with velocities (MovingFormat.H)
//     export/liquid_<index>.obj, .stl             of meshSurface's other formats, which have none
//
// <index> counts the files from 1, as frames of a film are counted.

#include "MovingFormat.H"
#include "caseFiles/DrawnSurface.H"
#include "caseFiles/LiquidFiles.H"
#include "core/arguments/runApplication.H"
#include "core/fieldFile/FieldFile.H"
#include "core/messages/Progress.H"
#include "core/time/Time.H"
#include "drops/BodyNumbers.H"
#include "meshes/FieldsAt.H"
#include "meshes/PlyFile.H"
#include "meshes/surfaceFormats/SurfaceFormat.H"

#include <algorithm>
#include <functional>
#include <iomanip>
#include <iostream>
#include <sstream>

using namespace shizuku;

namespace
{

using Writer = std::function<void(const std::filesystem::path& file, const MovingSurface& surface)>;

// The words that can be chosen.
std::vector<std::string> formatWords()
{
    std::vector<std::string> words = MovingFormatTable::words();
    for (const std::string& word : SurfaceFormatTable::words())
    {
        const bool isOfPictures = word == "obj" || word == "stl";       // vtp and pvtp are shizukuToVTK's
        if (isOfPictures) words.push_back(word);
    }
    return words;
}

Writer writerOf(const std::string& word)
{
    const std::vector<std::string> words = formatWords();
    if (std::find(words.begin(), words.end(), word) == words.end()) throw FatalInputError({}, "There is no format '" + word + "'", "one of those below", words, word);
    const std::vector<std::string> moving = MovingFormatTable::words();
    if (std::find(moving.begin(), moving.end(), word) != moving.end())
    {
        const std::shared_ptr<MovingFormat> format = MovingFormatTable::New("surface format", word, {});
        return [format](const std::filesystem::path& file, const MovingSurface& surface) { format->write(file, surface); };
    }
    const std::shared_ptr<SurfaceFormat> format = SurfaceFormatTable::New("surface format", word, {});
    return [format](const std::filesystem::path& file, const MovingSurface& surface) { format->write(file, surface.mesh); };
}

// The particles of a time, with what a surface takes of them.
class Particles
{
public:
    Particles(const TimeFolder& time, double spacing, BodyNumbers& numbers) : spacing_(spacing)
    {
        if (!std::filesystem::exists(time.path/"liquid/positions")) return;
        positions_ = readLiquidPositions(time.path);
        const std::vector<int> bodies = numbers.next(positions_, readLiquidIds(time.path, positions_.size()));
        body_.values.assign(bodies.begin(), bodies.end());
        const auto file = time.path/"liquid/U";
        if (std::filesystem::exists(file)) velocity_ = readField(file, FieldType::vector, dimensions::velocity, long(positions_.size()));
    }

    // m/s; at rest where the time has no velocities.
    std::vector<Vector3> velocitiesAt(const std::vector<Vector3>& places) const
    {
        std::vector<Vector3> velocities(places.size());
        if (positions_.empty() || velocity_.values.empty()) return velocities;
        const FieldData there = fieldsAt(places, positions_, {velocity_}, spacing_).front();
        for (std::size_t i = 0; i < places.size(); ++i)
        {
            for (int c = 0; c < 3; ++c) velocities[i][c] = there(i, c);
        }
        return velocities;
    }

    // 0 where the time has no particles.
    std::vector<int> bodiesAt(const std::vector<Vector3>& places) const
    {
        if (positions_.empty()) return std::vector<int>(places.size());
        const FieldData there = fieldsAt(places, positions_, {body_}, spacing_).front();
        return {there.values.begin(), there.values.end()};
    }

private:
    double spacing_;
    std::vector<Vector3> positions_;
    FieldData velocity_, body_{"body", FieldType::label, dimensions::none, false, {}};
};

std::string fileName(std::size_t index, const std::string& ending)
{
    std::ostringstream name;
    name << "liquid_" << std::setw(4) << std::setfill('0') << index << '.' << ending;
    return name.str();
}

void exportSurface(const Arguments& args)
{
    const double spacing = readSpacing(args.casePath());
    std::vector<std::pair<std::string, Writer>> formats;
    for (const std::string& word : args.getList("formats")) formats.emplace_back(word, writerOf(word));
    const auto holds = [](const TimeFolder& time) { return std::filesystem::exists(liquidSurfaceFile(time.path)); };
    const auto times = selectTimesWith(args, holds, "surface/liquid.ply", "the mesh of meshSurface");
    const auto folder = args.casePath()/"export";
    std::filesystem::create_directories(folder);
    BodyNumbers numbers(spacing);
    Progress progress("Exporting");
    for (std::size_t t = 0; t < times.size(); ++t)
    {
        const Particles particles(times[t], spacing, numbers);
        MovingSurface surface;
        surface.time = times[t].value;
        surface.spacing = spacing;
        const TriangleMesh closed = readPly(liquidSurfaceFile(times[t].path));
        surface.closed = &closed;
        surface.mesh = drawnSurface(closed, args.casePath());
        surface.mesh.normals.resize(surface.mesh.vertices.size());
        surface.velocities = particles.velocitiesAt(surface.mesh.vertices);
        surface.bodies = particles.bodiesAt(surface.mesh.vertices);
        surface.velocitiesAt = [&](const std::vector<Vector3>& places) { return particles.velocitiesAt(places); };
        for (const auto& [word, write] : formats) write(folder/fileName(t + 1, word), surface);
        progress.update(double(t + 1)/double(times.size()));
    }
    std::cout << "Written: " << times.size() << " times, " << (folder/fileName(1, formats.front().first)).string() << " to "
              << fileName(times.size(), formats.front().first) << '\n';
}

}

int main(int argc, char** argv)
{
    std::vector<Option> options = timeSelectionOptions();
    options.push_back({"formats", "LIST", "File formats, of ply, glb, vdb, obj, stl; the first three carry velocities, vdb needs OpenVDB in the build", "(ply)"});
    const ApplicationInfo info{"exportSurface", "Write meshes of the liquid with its velocities for Blender and the like.", options};
    return runApplication(argc, argv, info, exportSurface);
}
