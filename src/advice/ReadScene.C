// SPDX-License-Identifier: GPL-3.0-or-later
#include "advice/Scene.H"

#include "caseFiles/AnalyticSurface.H"
#include "caseFiles/CaseGravity.H"
#include "caseFiles/LiquidFiles.H"
#include "caseFiles/SampledWall.H"
#include "caseFiles/SolidParticles.H"
#include "caseFiles/VectorField.H"
#include "core/paths/Existence.H"
#include "core/time/Time.H"
#include "drops/KnownFaults.H"
#include "meshes/Bounds.H"
#include "meshes/NearestPoint.H"
#include "meshes/ObjFile.H"
#include "meshes/StlFile.H"
#include "models/pressure/shared/UsualIterations.H"
#include "models/smoothing/SmoothingShare.H"
#include "thetaModels/ContactAngleLaw.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double flat = 0.01;               // spacings, of a surface's corners from their plane
constexpr double digits = 1e-12;            // of a unit vector
constexpr double touching = 0.01;           // spacings

void readDictionaries(Scene& scene, const fs::path& path, const Time& time)
{
    const Dictionary solution = Dictionary::read(path/"system/solution");
    const Dictionary liquid = Dictionary::read(path/"constant/liquidProperties");
    const Dictionary models = Dictionary::read(path/"constant/models");
    scene.spacing = readSpacing(path);
    scene.density = liquid.lookupPositive("rho", dimensions::density);
    scene.viscosity = liquid.lookupDimensionedOr("nu", dimensions::kinematicViscosity, 0);
    scene.surfaceTension = liquid.lookupDimensionedOr("sigma", dimensions::surfaceTension, 0);
    scene.duration = std::max(0.0, time.endTime() - time.value());
    for (const char* kind : {"pressure", "surfaceTension", "wetting", "viscosity", "bodyForce", "particleShifting"})
    {
        scene.models[kind] = models.lookupOr<std::string>(kind, "none");
    }
    scene.gravity = caseGravity(path);
    if (fs::exists(path/"constant/g"))
    {
        scene.availableGravity =
            Dictionary::read(path/"constant/g").lookupDimensionedVector("value", dimensions::acceleration);
    }
    scene.maxCapillaryCo = time.controlDict().lookupOr("maxCapillaryCo", usualCapillaryCo);
    scene.smoothing = models.subDictOrEmpty("XSPHCoeffs").lookupOr("c", defaultsOfXSPH.c);
    scene.smoothingPerCapillaryStep =
        models.subDictOrEmpty("XSPHCoeffs").lookupOr("perCapillaryStep", scene.surfaceTension > 0 ? defaultsOfXSPH.perCapillaryStep : 0);
    scene.support = solution.subDictOrEmpty("kernel").lookupOr("support", 2.0);
    const UsualIterations& usual = scene.models.at("pressure") == "completedPbf" ? usualOfCompletedPbf : usualOfPbf;
    scene.maxIterations = solution.subDictOrEmpty("pressure").lookupOr("maxIterations", usual.maxIterations);
    scene.relaxation = solution.subDictOrEmpty("pressure").lookupOr("relaxation", usual.relaxation);
    scene.coarseGrid = solution.subDictOrEmpty("pressure").lookupOr("coarseGrid", false);
    scene.refillable = fs::exists(path/"system/fillLiquidDict");
}

// Empty where the file is of a kind that only sampleSurface reads, or not there any more: the particles are.
std::vector<Vector3> cornersOf(const SampledWall& wall)
{
    const std::string kind = wall.file.extension().string();
    if ((kind != ".stl" && kind != ".obj") || !shizuku::isThere(wall.file)) return {};
    const PatchedSurface surface = kind == ".stl" ? readStl(wall.file, wall.name) : readObj(wall.file, wall.name);
    std::vector<Vector3> corners = surface.mesh.vertices;
    for (Vector3& corner : corners) corner *= wall.scale;
    return corners;
}

void readTheta(SceneWall& wall, const fs::path& path, const Vector3& at)
{
    const fs::path file = path/"constant/wettability";
    if (!fs::exists(file)) return;
    const Dictionary all = Dictionary::read(file);
    if (!all.found(wall.name) || !all.isDict(wall.name)) return;       // its patches have names of their own
    const Dictionary dict = all.subDict(wall.name);
    if (const auto law = readLaw(dict, path))
    {
        wall.evenTheta = law->isUniform();
        wall.theta = law->at(at).theta;
        return;
    }
    const std::string type = dict.lookupOr<std::string>("type", "constant");
    wall.evenTheta = type == "constant";
    wall.theta = ThetaModelTable::New("contact-angle", type, dict.where(), dict, path)->theta(at);
}

// The plane through a sampled wall's surface, its normal towards the liquid.
void fitWall(SceneWall& wall, const std::vector<Vector3>& corners, const Vector3& liquid, double spacing)
{
    if (corners.empty()) return;
    const Bounds bounds = boundsOf(corners);
    wall.low = bounds.low;
    wall.high = bounds.high;
    const auto fit = fitPlane(corners);
    if (!fit) return;
    for (const Vector3& corner : corners)
    {
        if (std::abs(fit->plane.distance(corner)) > flat*spacing) return;
    }
    wall.plane = fit->plane;
    for (int c = 0; c < 3; ++c)
    {
        if (std::abs(wall.plane->normal[c]) < digits) wall.plane->normal[c] = 0;
    }
    if (wall.plane->distance(liquid) < 0) wall.plane->normal = -wall.plane->normal;
}

Vector3 centroidOf(const SeparateBody& body, const std::vector<Vector3>& positions)
{
    Vector3 sum;
    for (const int i : body.particles) sum += positions[i];
    return sum/double(body.particles.size());
}

// The wall that the body stands on, if it is flat and the only one.
std::optional<Footing> footingOf
(
    const SeparateBody& body, const std::vector<Vector3>& positions, const std::vector<AnalyticSurface>& analytic,
    const std::vector<SceneWall>& walls, double spacing
)
{
    const auto within = [&](auto distance)
    {
        return std::count_if
        (
            body.particles.begin(), body.particles.end(), [&](int i) { return distance(positions[i]) < spacing; }
        );
    };
    std::optional<Footing> footing;
    for (std::size_t w = 0; w < walls.size(); ++w)
    {
        // The analytic ones come first.
        const auto layer = w < analytic.size()
            ? within([&](const Vector3& x) { return analytic[w].signedDistance(x); })
            : walls[w].plane ? within([&](const Vector3& x) { return walls[w].plane->distance(x); }) : -1;
        if (layer == 0) continue;
        // A wall of a shape that is not known may be next to it.
        if (layer < 0 || footing || !walls[w].plane) return std::nullopt;
        footing = {w, double(layer)*spacing*spacing*spacing, spacing};
    }
    return footing;
}

// From a body to the nearest wall, surface to surface.
class Gaps
{
public:
    Gaps(const std::vector<Vector3>& solid, const std::vector<AnalyticSurface>& analytic, const std::vector<SceneWall>& walls)
    : analytic_(analytic), walls_(walls), solid_(solid)
    {
        if (!solid_.empty()) nearest_ = std::make_unique<NearestPoint>(solid_);
    }

    double of(const SeparateBody& body, const std::vector<Vector3>& positions, double spacing) const
    {
        double gap = infinite;
        for (const int i : body.particles)
        {
            const Vector3& x = positions[i];
            for (const AnalyticSurface& surface : analytic_) gap = std::min(gap, surface.signedDistance(x) - 0.5*spacing);
            for (const SceneWall& wall : walls_)
            {
                if (wall.type == "particles" && wall.plane) gap = std::min(gap, wall.plane->distance(x) - 0.5*spacing);
            }
            // Solid particles lie half a spacing inside.
            if (nearest_) gap = std::min(gap, length(solid_[(*nearest_)(x)] - x) - spacing);
        }
        return gap;
    }

private:
    const std::vector<AnalyticSurface>& analytic_;
    const std::vector<SceneWall>& walls_;
    const std::vector<Vector3>& solid_;
    std::unique_ptr<NearestPoint> nearest_;
};

// at: where contact angles count. The analytic ones come first.
void readWalls(Scene& scene, const fs::path& path, const std::vector<AnalyticSurface>& analytic, const Vector3& at)
{
    for (const AnalyticSurface& surface : analytic)
    {
        SceneWall wall{surface.name, typeName(surface.type), {}, {}, {}, {}};
        if (surface.type == AnalyticSurface::Type::plane) wall.plane = Plane{surface.point, surface.direction};
        readTheta(wall, path, at);
        scene.walls.push_back(wall);
    }
    for (const SampledWall& sampled : readSampledWalls(path))
    {
        SceneWall wall{sampled.name, "particles", {}, {}, {}, {}};
        fitWall(wall, cornersOf(sampled), at, scene.spacing);
        readTheta(wall, path, at);
        scene.walls.push_back(wall);
    }
}

}

Scene Scene::read(const fs::path& path, const fs::path& filled, const StoredStudies& studies, double tolerance)
{
    Scene scene;
    scene.studies = &studies;
    scene.tolerance = tolerance;
    const Time time(filled);
    readDictionaries(scene, path, time);

    const std::vector<Vector3> positions = readLiquidPositions(time.path(), scene.spacing);
    const FieldData U =
        readField(time.path()/"liquid/U", FieldType::vector, dimensions::velocity, long(positions.size()));
    const std::vector<SeparateBody> bodies = separateBodies(positions, toVectors(U, positions.size()), scene.spacing);

    const std::vector<AnalyticSurface> analytic = readAnalyticSurfaces(Dictionary::read(path/"constant/walls"));
    readWalls(scene, path, analytic, centroidOf(bodies.front(), positions));

    const SolidParticles solid = haveSolidParticles(path) ? readSolidParticles(path) : SolidParticles();
    for (const Suspect& fault : knownFaults(path, solid, analytic, positions, scene.spacing)) scene.faults.push_back(fault.text);

    const Gaps gaps(solid.positions, analytic, scene.walls);
    for (const SeparateBody& body : bodies)
    {
        const double gap = gaps.of(body, positions, scene.spacing);
        SceneBody each{body, length(body.velocity), gap < touching*scene.spacing ? 0 : gap, 0};
        const double fall = std::isfinite(each.gap) ? each.gap : 0;
        each.footing = footingOf(body, positions, analytic, scene.walls, scene.spacing);
        each.impactSpeed = std::sqrt(each.speed*each.speed + 2*length(scene.gravity)*fall);
        scene.bodies.push_back(each);
    }
    return scene;
}

}
