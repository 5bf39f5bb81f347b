#include "advice/Scene.H"

#include "core/time/Time.H"
#include "geometry/AnalyticSurface.H"
#include "geometry/CaseGravity.H"
#include "geometry/LiquidFiles.H"
#include "geometry/NearestPoint.H"
#include "geometry/ObjFile.H"
#include "geometry/SampledWall.H"
#include "geometry/SolidParticles.H"
#include "geometry/StlFile.H"
#include "geometry/VectorField.H"
#include "geometry/thetaModels/ThetaModel.H"
#include "models/viscosity/XSPH/SmoothingShare.H"
#include "reference/CapillaryStep.H"

#include <algorithm>
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
constexpr double smallestBond = 0.05;       // (R/l)^2, below which a drop on a wall is that of no gravity

// Empty where the file is of a kind that only sampleSurface reads, or not there any more: the particles are.
std::vector<Vector3> cornersOf(const SampledWall& wall)
{
    const std::string kind = wall.file.extension().string();
    if ((kind != ".stl" && kind != ".obj") || !fs::exists(wall.file)) return {};
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
    const std::string type = dict.lookupOr<std::string>("type", "constant");
    wall.evenTheta = type == "constant";
    wall.theta = ThetaModelTable::New("contact-angle", type, dict.where(), dict, path)->theta(at);
}

// The plane through a sampled wall's surface, its normal towards the liquid.
void fitWall(SceneWall& wall, const std::vector<Vector3>& corners, const Vector3& liquid, double spacing)
{
    if (corners.empty()) return;
    wall.low = wall.high = corners.front();
    for (const Vector3& corner : corners)
    {
        for (int c = 0; c < 3; ++c)
        {
            wall.low[c] = std::min(wall.low[c], corner[c]);
            wall.high[c] = std::max(wall.high[c], corner[c]);
        }
    }
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
    Gaps(const fs::path& path, const std::vector<AnalyticSurface>& analytic, const std::vector<SceneWall>& walls)
    : analytic_(analytic), walls_(walls)
    {
        if (!haveSolidParticles(path)) return;
        const std::vector<Vector3> solid = readSolidParticles(path).positions;
        if (solid.empty()) return;
        solid_ = solid;
        nearest_ = std::make_unique<NearestPoint>(solid_);
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
    std::vector<Vector3> solid_;
    std::unique_ptr<NearestPoint> nearest_;
};

}

Scene Scene::read(const fs::path& path, const fs::path& filled, const StoredStudies& studies, double tolerance)
{
    Scene scene;
    scene.studies = &studies;
    scene.tolerance = tolerance;

    const Dictionary solution = Dictionary::read(path/"system/solution");
    const Dictionary liquid = Dictionary::read(path/"constant/liquidProperties");
    const Dictionary models = Dictionary::read(path/"constant/models");
    const Time time(filled);
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
    scene.maxCapillaryCo = time.controlDict().lookupOr("maxCapillaryCo", 0.3);
    scene.smoothing = models.subDictOrEmpty("XSPHCoeffs").lookupOr("c", 0.05);
    scene.smoothingPerCapillaryStep = models.subDictOrEmpty("XSPHCoeffs").lookupOr("perCapillaryStep", 0.0);
    scene.support = solution.subDictOrEmpty("kernel").lookupOr("support", 2.0);
    scene.maxIterations = solution.subDictOrEmpty("pressure").lookupOr("maxIterations", 0);
    scene.coarseGrid = solution.subDictOrEmpty("pressure").lookupOr("coarseGrid", false);
    scene.refillable = fs::exists(path/"system/fillLiquidDict");

    const std::vector<Vector3> positions = readLiquidPositions(time.path());
    const FieldData U =
        readField(time.path()/"liquid/U", FieldType::vector, dimensions::velocity, long(positions.size()));
    const std::vector<Vector3> velocities = toVectors(U, positions.size());
    const std::vector<SeparateBody> bodies = separateBodies(positions, velocities, scene.spacing);

    const std::vector<AnalyticSurface> analytic = readAnalyticSurfaces(Dictionary::read(path/"constant/walls"));
    const Vector3 centre = centroidOf(bodies.front(), positions);
    for (const AnalyticSurface& surface : analytic)
    {
        SceneWall wall{surface.name, typeName(surface.type), {}, {}, {}, {}};
        if (surface.type == AnalyticSurface::Type::plane) wall.plane = Plane{surface.point, surface.direction};
        readTheta(wall, path, centre);
        scene.walls.push_back(wall);
    }
    for (const SampledWall& sampled : readSampledWalls(path))
    {
        SceneWall wall{sampled.name, "particles", {}, {}, {}, {}};
        fitWall(wall, cornersOf(sampled), centre, scene.spacing);
        readTheta(wall, path, centre);
        scene.walls.push_back(wall);
    }

    const Gaps gaps(path, analytic, scene.walls);
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

FlowScales Scene::scales(const SceneBody& body) const
{
    return {body.liquid.diameter(), body.impactSpeed, length(gravity), density, viscosity, surfaceTension};
}

const SceneBody& Scene::smallest() const
{
    std::size_t last = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        if (bodies[i].liquid.volume >= 0.1*bodies.front().liquid.volume) last = i;
    }
    return bodies[last];
}

double Scene::particles(const SceneBody& body) const { return body.liquid.volume/(spacing*spacing*spacing); }

std::optional<double> Scene::theta() const
{
    double sum = 0;
    int count = 0;
    for (const SceneWall& wall : walls)
    {
        // The floor of a vessel is covered: its angle shows nowhere.
        if (!wall.theta || (wall.type == "plane" && isTube())) continue;
        sum += *wall.theta;
        ++count;
    }
    if (count == 0) return std::nullopt;
    return sum/count;
}

bool Scene::isTube() const
{
    return std::any_of(walls.begin(), walls.end(), [](const SceneWall& wall) { return wall.type == "cylinder"; });
}

bool Scene::isVessel() const
{
    constexpr int sides = 4;
    int planes = 0;
    for (const SceneWall& wall : walls)
    {
        if (wall.type == "cylinder" || wall.type == "box") return true;
        if (wall.plane) ++planes;
    }
    return planes >= sides;
}

std::optional<ModelSet> Scene::modelSet() const
{
    return studies->modelSet(models.at("pressure"), models.at("surfaceTension"), models.at("wetting"));
}

SceneAnswer Scene::answer() const
{
    if (!hasTension())
    {
        if (walls.empty() || length(gravity) == 0) return {"", 0, "none that a stored study has"};
        return {"damBreak", 0, "front of liquid that collapses"};
    }
    if (walls.empty()) return {"oscillation", 0, "period of a free drop"};
    if (std::any_of(bodies.begin(), bodies.end(), [&](const SceneBody& body) { return mayJumpOff(body); }))
    {
        return {"", 0, "none that a stored study has: liquid starts with the energy to leave its wall"};
    }
    const std::string angle = theta() ? number(*theta()) + " degrees" : "";
    if (isTube() && length(gravity) > 0 && theta()) return {"meniscus", *theta(), "meniscus at " + angle};
    const double bond = flowNumbers(scales(bodies.front())).bond/4;        // of the radius
    if (bond >= smallestBond) return {"gravity", bond, "height of a drop at the Bond number (R/l)^2 " + number(bond)};
    if (theta()) return {"sessile", *theta(), "contact angle of " + angle};
    return {"", 0, "none that a stored study has"};
}

double Scene::modelViscosity() const
{
    const std::string& model = models.at("viscosity");
    const double h = support*spacing;
    if (model != "XSPH") return model == "none" ? 0 : viscosity;
    const double steps = subStep/capillaryStep(density*std::pow(spacing, 3), surfaceTension);
    return smoothingShare(smoothing, smoothingPerCapillaryStep, steps)*3/40*h*h/(2*subStep);
}

std::optional<CapStart> Scene::start(const SceneBody& body, double nu) const
{
    if (!body.footing || surfaceTension <= 0 || !hasTension()) return std::nullopt;
    const SceneWall& wall = walls[body.footing->wall];
    if (!wall.theta || !wall.evenTheta) return std::nullopt;
    const double R = 0.5*body.liquid.diameter(), pressing = -dot(gravity, wall.plane->normal);
    if (pressing < 0) return std::nullopt;
    return CapStart
    {
        capAngleOf(body.footing->layer/body.liquid.volume, body.footing->depth/R), *wall.theta,
        density*pressing*R*R/surfaceTension, nu*std::sqrt(density/(surfaceTension*R))
    };
}

bool Scene::mayJumpOff(const SceneBody& body) const
{
    const auto cap = start(body, viscosity);
    return cap && jumpOff(*cap).excess();
}

std::optional<StoredNumber> Scene::error() const
{
    const auto set = modelSet();
    const SceneAnswer asked = answer();
    if (!set || asked.scene.empty()) return std::nullopt;
    return studies->error(asked.scene, asked.parameter, set->name, particles(smallest()), maxCapillaryCo);
}

std::optional<double> Scene::likelyError() const
{
    const auto typical = error();
    if (!typical) return std::nullopt;
    const std::string set = modelSet()->name;
    const std::vector<double> run = studies->particles(answer().scene, set);
    const double n = particles(smallest());
    const auto scatter = studies->scatter(set);
    constexpr double digits = 0.01;             // of a spacing of three digits
    if (!scatter || n < (1 - digits)*run.front() || n > (1 + digits)*run.back()) return std::nullopt;
    return *scatter*typical->value;
}

}
