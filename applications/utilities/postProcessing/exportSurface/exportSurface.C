// SPDX-License-Identifier: GPL-3.0-or-later
// exportSurface: the meshes of meshSurface as a numbered series, with the liquid's velocities, for Blender and other programs for pictures.
//
//     export/liquid_<index>.ply, .glb     with velocities (MovingSurface.H)
//     export/liquid_<index>.obj, ...      the other formats of meshSurface, which have none
//
// <index> counts the files from 1, as frames of a film are counted.

#include "MovingSurface.H"
#include "caseFiles/LiquidFiles.H"
#include "core/arguments/runApplication.H"
#include "core/fieldFile/FieldFile.H"
#include "core/messages/Progress.H"
#include "core/time/Time.H"
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
    std::vector<std::string> words{"ply", "glb"};
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
    if (word == "ply") return writeMovingPly;
    if (word == "glb") return writeGlb;
    const std::shared_ptr<SurfaceFormat> format = SurfaceFormatTable::New("surface format", word, {});
    return [format](const std::filesystem::path& file, const MovingSurface& surface) { format->write(file, surface.mesh); };
}

// Of the vertices; at rest where the time has no velocities.
std::vector<Vector3> velocitiesAt(const std::vector<Vector3>& vertices, const TimeFolder& time, double spacing)
{
    std::vector<Vector3> velocities(vertices.size());
    const auto file = time.path/"liquid/U";
    if (!std::filesystem::exists(file)) return velocities;
    const std::vector<Vector3> particles = readLiquidPositions(time.path);
    const FieldData field = readField(file, FieldType::vector, dimensions::velocity, long(particles.size()));
    const std::vector<FieldData> there = fieldsAt(vertices, particles, {field}, spacing);
    if (there.empty()) return velocities;
    for (std::size_t i = 0; i < vertices.size(); ++i)
    {
        for (int c = 0; c < 3; ++c) velocities[i][c] = there.front()(i, c);
    }
    return velocities;
}

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
    Progress progress("Exporting");
    for (std::size_t t = 0; t < times.size(); ++t)
    {
        MovingSurface surface{times[t].value, readPly(liquidSurfaceFile(times[t].path)), {}};
        surface.mesh.normals.resize(surface.mesh.vertices.size());
        surface.velocities = velocitiesAt(surface.mesh.vertices, times[t], spacing);
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
    options.push_back({"formats", "LIST", "File formats, of ply, glb, obj, stl; the first two carry velocities", "(ply)"});
    const ApplicationInfo info{"exportSurface", "Write meshes of the liquid with its velocities for Blender and the like.", options};
    return runApplication(argc, argv, info, exportSurface);
}
