// SPDX-License-Identifier: GPL-3.0-or-later
// Renders times of a case off screen: the liquid's surface as water, or its particles, on their wall.

#include "WallsOfPicture.H"
#include "AngleCaption.H"
#include "CurvedWalls.H"
#include "FloorPattern.H"
#include "Movie.H"

#include "caseFiles/CaseGravity.H"
#include "caseFiles/DrawnSurface.H"
#include "caseFiles/LiquidFiles.H"
#include "caseFiles/WallPlane.H"
#include "core/arguments/runApplication.H"
#include "core/dictionary/Dictionary.H"
#include "core/messages/Progress.H"
#include "core/paths/Existence.H"
#include "core/time/LatestTime.H"
#include "meshes/MeshTopology.H"
#include "meshes/PlyFile.H"
#include "optics/LiquidLook.H"
#include "vtk/Picture.H"
#include "vtk/PvtpFile.H"
#include "vtk/VirtualDisplay.H"
#include "wallMotions/WallMotions.H"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <regex>
#include <set>
#include <sstream>

using namespace shizuku;

namespace
{

bool hasSurface(const TimeFolder& time)
{
    return std::filesystem::exists(liquidSurfaceFile(time.path)) || std::filesystem::exists(liquidSurfaceFile(time.path, "pvtp"));
}

// As one mesh, or in pieces.
TriangleMesh readSurface(const TimeFolder& time)
{
    const auto mesh = liquidSurfaceFile(time.path);
    TriangleMesh whole = std::filesystem::exists(mesh) ? readPly(mesh) : withSharedVertices(readPieces(piecesOfPvtp(liquidSurfaceFile(time.path, "pvtp"))));
    return drawnSurface(std::move(whole), time.path.parent_path());
}

bool hasLiquid(const TimeFolder& time)
{
    return hasSurface(time) || std::filesystem::exists(time.path/"liquid/positions");
}

// The selected times that hold liquid. Where none is selected those with a surface, or of a case without surfaces those with particles: of a film all, else the latest.
std::vector<TimeFolder> chosenTimes(const Arguments& args)
{
    const std::string expected = "<time>/surface/liquid.ply or .pvtp of meshSurface, or <time>/liquid";
    if (args.found("time") || args.found("listTimes")) return selectTimesWith(args, hasLiquid, "liquid", expected);
    const std::vector<TimeFolder> all = timeFolders(args.casePath());
    const bool meshed = std::any_of(all.begin(), all.end(), hasSurface);
    const auto holds = meshed ? hasSurface : hasLiquid;
    const std::string what = meshed ? "a surface mesh" : "liquid";
    if (args.found("movie") && !args.found("latestTime")) return selectTimesWith(args, holds, what, expected);
    return {latestTimeWith(args.casePath(), holds, what, expected)};
}

void readSize(PictureView& view, const std::string& size)
{
    constexpr int smallest = 16, largest = 8192;        // twice that, oversampled, is what graphics drivers take
    std::smatch match;
    if (std::regex_match(size, match, std::regex("([0-9]{1,5})x([0-9]{1,5})")))
    {
        view.width = std::stoi(match[1]);
        view.height = std::stoi(match[2]);
        const auto [less, more] = std::minmax(view.width, view.height);
        if (less >= smallest && more <= largest) return;
    }
    throw FatalInputError
    (
        {}, "Option -size has the value '" + size + "'", "WIDTHxHEIGHT in pixels from 16 to 8192, e.g. 1600x1000"
    );
}

Vector3 readCentre(const Arguments& args)
{
    const std::vector<std::string> words = args.getList("centre");
    int read = 0;
    Vector3 centre;
    for (int axis = 0; axis < 3 && words.size() == 3; ++axis)
    {
        char* end = nullptr;
        centre[axis] = std::strtod(words[axis].c_str(), &end);
        if (*end == 0 && std::isfinite(centre[axis])) ++read;
    }
    if (read == 3) return centre;
    throw FatalInputError
    (
        {}, "Option -centre has the value '" + args.get("centre") + "'", "a point in metres, e.g. '(0 0 1e-3)'"
    );
}

PictureView readView(const Arguments& args)
{
    PictureView view;
    const std::string kind = args.get("view");
    view.kind = kind == "side" ? PictureView::Kind::side
        : kind == "above" ? PictureView::Kind::above : PictureView::Kind::perspective;
    readSize(view, args.get("size"));
    view.azimuth = args.getDouble("azimuth");
    if (args.found("centre")) view.centre = readCentre(args);
    if (args.found("width"))
    {
        view.extent = args.getDouble("width");
        if (!(*view.extent > 0)) throw FatalInputError({}, "Option -width is not positive", "metres, e.g. 0.01");
    }
    return view;
}

void addLiquid(PictureScene& scene, const TimeFolder& time)
{
    if (hasSurface(time))
    {
        scene.liquid = readSurface(time);
        return;
    }
    scene.particles = readLiquidPositions(time.path);
    const auto velocity = time.path/"liquid/U";
    if (!std::filesystem::exists(velocity)) return;
    const FieldData u = readField(velocity, FieldType::vector, dimensions::velocity, long(scene.particles.size()));
    for (std::size_t i = 0; i < scene.particles.size(); ++i)
    {
        scene.speed.push_back(std::hypot(u(i, 0), u(i, 1), u(i, 2)));
    }
}

// Around the liquid of all of them.
Bounds boundsOf(const std::vector<TimeFolder>& times)
{
    Bounds all;
    for (const TimeFolder& time : times)
    {
        PictureScene scene;
        addLiquid(scene, time);
        for (const Vector3& x : scene.liquid.vertices.empty() ? scene.particles : scene.liquid.vertices) all.add(x);
    }
    return all;
}

// Solid particles behind a plane: it is a face of a body, and no floor.
bool isFace(const Plane& plane, const SolidParticles& solid, double spacing)
{
    constexpr double layer = 2;         // spacings
    const auto isBehind = [&](const Vector3& x) { return plane.distance(x) < -layer*spacing; };
    return std::any_of(solid.positions.begin(), solid.positions.end(), isBehind);
}

// The first plane wall is the floor. Other patches are shown by the surface that they were sampled from, or by their
// particles where that is not there.
void addWalls(PictureScene& scene, const std::filesystem::path& casePath, double time)
{
    const CaseWalls walls = readCaseWalls(casePath, time);
    std::set<std::string> shown(walls.solid.patches.begin(), walls.solid.patches.end());
    for (const std::string& name : walls.names)
    {
        const auto plane = planeOf(walls, name, scene.spacing);
        if (!plane || (shown.contains(name) && isFace(*plane, walls.solid, scene.spacing))) continue;
        if (!scene.floor) scene.floor = plane;
        shown.erase(name);
    }
    const CurvedWalls curved = readCurvedWalls(casePath, shown, time);
    scene.walls = curved.mesh;
    addAnalyticWalls(scene, walls.analytic);
    for (std::size_t i = 0; i < walls.solid.positions.size(); ++i)
    {
        const std::string& patch = walls.solid.patches[walls.solid.patch[i]];
        if (shown.contains(patch) && !curved.patches.contains(patch)) scene.solid.push_back(walls.solid.positions[i]);
    }
}

// Against gravity, where the case has it; else the floor's normal.
Vector3 upward(const std::filesystem::path& casePath, const std::optional<Plane>& floor)
{
    const Vector3 g = caseGravity(casePath);
    if (length(g) > 0) return -normalized(g);
    return floor ? floor->normal : Vector3(0, 0, 1);
}

// Of one time the name as it is given, of several with the time behind it: drop.png, drop_0.005.png.
std::filesystem::path fileOf(const Arguments& args, const TimeFolder& time, bool several)
{
    std::filesystem::path file = args.found("output")
        ? std::filesystem::absolute(args.get("output"))
        : args.casePath()/(args.casePath().filename().string() + ".png");
    if (file.extension() != ".png") throw FatalError("The picture " + file.string() + " is no PNG by its name\n    Expected: a name that ends in .png");
    if (several) file.replace_filename(file.stem().string() + "_" + time.name + ".png");
    return file;
}

// Of the option, or by the liquid of constant/liquidProperties: mercury is heavy, honey is thick.
std::string lookOf(const Arguments& args)
{
    if (args.found("look") && args.get("look") != "fine") return args.get("look");
    const auto file = args.casePath()/"constant/liquidProperties";
    if (!isThere(file)) return "water";
    const Dictionary liquid = Dictionary::read(file);
    constexpr double heavy = 1e4, thick = 1e-4;         // kg/m3, m2/s
    if (liquid.lookupDimensionedOr("rho", dimensions::density, 0) > heavy) return "mercury";
    return liquid.lookupDimensionedOr("nu", dimensions::kinematicViscosity, 0) > thick ? "honey" : "water";
}

PictureScene sceneOf(const Arguments& args, const TimeFolder& time, const std::string& angle)
{
    PictureScene scene;
    scene.look = lookOf(args);
    scene.isFine = args.found("look") && args.get("look") == "fine";
    scene.spacing = readSpacing(args.casePath());
    addLiquid(scene, time);
    if (scene.isFine && scene.liquid.faces.empty()) throw FatalError("The time " + time.name + " has no surface for -look fine\n    Run meshSurface first");
    addWalls(scene, args.casePath(), time.value);
    addFloorPattern(scene, args.casePath(), time);
    scene.up = upward(args.casePath(), scene.floor);
    std::ostringstream caption;
    caption << args.casePath().filename().string() << ", t = " << 1e3*time.value << " ms";
    scene.caption = caption.str() + (angle.empty() ? "" : "\n" + angle);
    return scene;
}

void renderTime(const Arguments& args, const TimeFolder& time, const PictureView& view, const std::filesystem::path& file)
{
    const std::string angle = angleCaption(args.casePath(), time.value);
    renderPicture(sceneOf(args, time, angle), view, file);
    std::cout << "Time = " << time.name << "\n" << angle << (angle.empty() ? "" : "\n");
}

void renderMovie(const Arguments& args, const std::vector<TimeFolder>& times, const PictureView& view)
{
    const Movie movie(args.get("movie"), args.getDouble("rate"));
    Progress progress("Film");
    for (std::size_t i = 0; i < times.size(); ++i)
    {
        renderTime(args, times[i], view, movie.picture(i));
        progress.update(double(i + 1)/double(times.size()));
    }
    movie.write();
    std::cout << "Written: " << std::filesystem::absolute(args.get("movie")).string() << ", " << times.size() << " pictures" << std::endl;
}

// Once for all times: a film has many.
void tellOfParticles(const std::vector<TimeFolder>& times)
{
    const auto without = std::count_if(times.begin(), times.end(), [](const TimeFolder& time) { return !hasSurface(time); });
    if (without == 0) return;
    std::cout << "No surface";
    if (times.size() > 1) std::cout << " at " << without << " of " << times.size() << " times";
    std::cout << ": particles are drawn. Run meshSurface before renderCase for a surface\n";
}

void render(const Arguments& args)
{
    if (args.found("movie") && args.found("output")) throw FatalInputError({}, "Both -movie and -output are given", "one of them");
    const std::vector<TimeFolder> times = chosenTimes(args);
    PictureView view = readView(args);
    if (times.size() > 1) view.frame = boundsOf(times);
    std::vector<std::filesystem::path> files;
    for (const TimeFolder& time : times) files.push_back(fileOf(args, time, times.size() > 1));
    tellOfParticles(times);
    const VirtualDisplay display;
    if (args.found("movie"))
    {
        renderMovie(args, times, view);
        return;
    }
    for (std::size_t i = 0; i < times.size(); ++i)
    {
        renderTime(args, times[i], view, files[i]);
        std::cout << "Written: " << files[i].string() << std::endl;
    }
}

}

int main(int argc, char** argv)
{
    std::vector<Option> options = timeSelectionOptions();
    options.push_back({"output", "FILE", "The PNG; FILE_TIME.png for several times (default: <case>/<name of the case>.png)", ""});
    options.push_back({"size", "WxH", "Size of the picture in pixels", "1600x1000"});
    options.push_back({"azimuth", "DEGREES", "Angle of the viewer around the liquid, anticlockwise seen from above", "0"});
    options.push_back({"centre", "(X Y Z)", "Centre of the picture, m (default: centre of the liquid)", ""});
    options.push_back({"width", "METRES", "Width of the picture at its centre (default: the liquid of all times fits)", ""});
    options.push_back({"view", "side|perspective|above", "Look level, down slightly, or down from above", "perspective"});
    options.push_back({"look", "water|honey|mercury|ink|plain|fine", "Look of the liquid (default: by its density and viscosity); plain is blue and opaque; fine: by POV-Ray", ""});
    options.push_back({"movie", "FILE", "A film of the selected times, or of all times, by ffmpeg: .mp4 or .gif", ""});
    options.push_back({"rate", "N", "Pictures of the film per second", "25"});
    return runApplication
    (
        argc, argv,
        {"renderCase", "Render the latest time, or selected times, to PNG files or a film, without a display.", options}, render
    );
}
