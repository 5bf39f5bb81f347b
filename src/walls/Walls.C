// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/Walls.H"

#include "caseFiles/AnalyticSurface.H"
#include "caseFiles/SolidParticles.H"
#include "core/angles/Degrees.H"
#include "core/time/Time.H"
#include "device/ForEach.H"
#include "maths/Simpson.H"
#include "thetaModels/LineLaws.H"
#include "thetaModels/ThetaField.H"
#include "wallMotions/SixDoFBody.H"
#include "walls/KeepOutside.H"
#include "walls/LiquidInside.H"
#include "walls/WallsAtSides.H"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace shizuku
{

namespace
{

// theta in degrees
scalar cosine(double theta) { return scalar(std::cos(radians(theta))); }

void refuseNoAngles(const std::vector<double>& thetas, const SourceLocation& where)
{
    const auto isNone = [](double theta) { return !(theta >= 0 && theta <= 180); };
    const auto none = std::find_if(thetas.begin(), thetas.end(), isNone);
    if (none == thetas.end()) return;
    std::ostringstream text;
    text << "A contact angle of " << *none << " degrees";
    throw FatalInputError(where, text.str(), "0 to 180 degrees");
}

Place scaled(const Vector3& v, double unit) { return placeAt(v.x / unit, v.y / unit, v.z / unit); }

WallSurface curvedOrPlane(const AnalyticSurface& surface, double unit)
{
    using Type = AnalyticSurface::Type;
    const Vector3& n = surface.direction;
    const auto type = surface.type == Type::plane ? WallSurface::planeAcross(n.x, n.y, n.z)
        : surface.type == Type::sphere ? WallSurface::sphere : WallSurface::cylinder;
    return
    {
        type, -1, scaled(surface.point, unit), {surface.direction.x, surface.direction.y, surface.direction.z}, surface.radius / unit,
        surface.liquidInside ? -1.0f : 1.0f, 0
    };
}

// By how much a sphere of that radius is too large for liquid around it where walls have a half-space's kernel density. Behind its tangent plane it lacks a layer r^2/(2 R) thick at r from the
// middle: on the mean sigma^2/R, sigma^2 the kernel's second moment along an axis.
double excessOfRadius(const KernelChoice& kernel, double radius)
{
    const double square = std::visit([](const auto& W)
    {
        return integrate(0, W.h, [&](double r) { return 4 * kernels::pi / 3 * r * r * r * r * W.W(scalar(r)); });
    }, kernel);
    return square / radius;
}

// The six planes of a box that holds the liquid.
std::vector<WallSurface> facesOf(const AnalyticSurface& box, double unit)
{
    const Place low = scaled(box.min, unit), high = scaled(box.max, unit);
    std::vector<WallSurface> faces;
    for (const WallSurface::Direction n : {WallSurface::Direction{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    {
        faces.push_back({WallSurface::planeAcross(n.x, n.y, n.z), -1, low, n, 0, 1, 0});
        faces.push_back({WallSurface::planeAcross(n.x, n.y, n.z), -1, high, {-n.x, -n.y, -n.z}, 0, 1, 0});
    }
    return faces;
}

}

Walls::Walls(const std::filesystem::path& casePath, double startTime, const Liquid& liquid)
:
    case_(casePath), startTime_(startTime), dict_(Dictionary::read(casePath / "constant/walls"))
{
    for (const AnalyticSurface& surface : readAnalyticSurfaces(dict_))
    {
        const double unit = liquid.units().length;
        const auto faces = surface.type == AnalyticSurface::Type::box
            ? facesOf(surface, unit) : std::vector{curvedOrPlane(surface, unit)};
        for (const WallSurface& face : faces)
        {
            analytic_.push_back(face);
            surfaceNames_.push_back(surface.name);
            if (face.isFlat()) constraints_.constrain({scalar(face.direction.x), scalar(face.direction.y), scalar(face.direction.z)});
            else constraints_.constrainAll();
        }
    }
    giveSurfaces();
    if (surfaces_.count > 0)
    {
        halfSpace_.upload(tabulateHalfSpace(liquid.kernel()));
        surfaces_.halfSpace = {halfSpace_.span(), liquid.support()};
    }
    if (useSolidParticles(casePath))
    {
        layer_.emplace(casePath, dict_.where(), liquid);
        layer_->constrain(constraints_);
    }
    dict_.refuseUnused();
    if (const Images* images = liquid.ghosts().images())
    {
        sideConstraints_.constrain(images->sides().box());
        constraints_.constrain(images->sides().box());
        refuseBreaksAtSides(casePath, dict_, images->sides(), liquid);
    }
    useBodies(liquid, WallMotions::read(casePath));
    if (SixDoFBody* body = freeBody())
    {
        body->refuseLight(liquid.properties().density);
        body->begin(startTime);
        double& radius = analytic_[surfaceOfBody()].radius;
        radius -= excessOfRadius(liquid.kernel(), radius);
    }
    moveTo(startTime, startTime);
}

// Nothing is done, and nothing needed, where no wall moves.
void Walls::useBodies(const Liquid& liquid, WallMotions motions)
{
    if (motions.none()) return;
    bodies_ = WallBodies(std::move(motions), liquid.units());
    for (std::size_t a = 0; a < analytic_.size(); ++a) analytic_[a].body = bodies_.motions().indexOf(surfaceNames_[a]);
    given_ = analytic_;
    if (layer_) layer_->setBodies(bodies_.motions().indicesOf(case_, readSolidParticles(case_)), liquid);
    if (bodies_.turn()) constraints_.constrainAll();        // its normals are others in each step
}

int Walls::surfaceOfBody() const
{
    return int(std::find(surfaceNames_.begin(), surfaceNames_.end(), freeBody()->wall()) - surfaceNames_.begin());
}

void Walls::moveTo(double from, double to)
{
    if (bodies_.none()) return;
    bodies_.moveTo(from, to);
    for (std::size_t a = 0; a < analytic_.size(); ++a)
    {
        WallSurface& surface = analytic_[a];
        if (surface.body < 0) continue;
        const BodyPose& pose = bodies_.pose(surface.body);
        surface.point = pose(given_[a].point);
        if (!bodies_.motions().walls()[surface.body].motion->axis()) continue;
        surface.direction = pose.turned(given_[a].direction);
        if (surface.isFlat()) surface.type = WallSurface::planeAcross(surface.direction.x, surface.direction.y, surface.direction.z);
    }
    giveSurfaces();
    if (layer_) layer_->move(bodies_);
}

void Walls::refuseMotions(const Liquid& liquid, const WallMotions& motions, double time) const
{
    constexpr double most = 0.01;               // spacings
    const double spacing = liquid.properties().spacing;
    const WallMotions& former = bodies_.motions();
    const auto refuse = [&](const std::string& wall, const std::string& what)
    {
        const Dictionary walls = Dictionary::read(case_ / "constant/walls");
        throw FatalInputError(walls.where(walls.found(wall) ? wall : ""), "The motion of the wall '" + wall + "' was changed: " + what, "a motion that goes on from where the wall is, or a new run");
    };
    for (const MovingWall& wall : former.walls())
    {
        if (motions.indexOf(wall.name) < 0) refuse(wall.name, std::string("it has none any more, which ") + (wall.motion->body() ? "`translations (); rotations ();` does" : "stop does"));
    }
    for (const MovingWall& wall : motions.walls())
    {
        const int before = former.indexOf(wall.name);
        if (before < 0) refuse(wall.name, "it had none when the run began");
        const WallMotion& was = *former.walls()[before].motion;
        if (!was.body() != !wall.motion->body()) refuse(wall.name, was.body() ? "the liquid moves it no more, and `translations (); rotations ();` is what holds it" : "the liquid moves it now");
        if (const SixDoFBody* body = wall.motion->body())
        {
            body->refuseLight(liquid.properties().density);
            body->refuseOtherStart(*was.body());
            continue;
        }
        const auto axis = was.axis(), axisNow = wall.motion->axis();
        if (axis.has_value() != axisNow.has_value()) refuse(wall.name, axis ? "it turns no more" : "it turns now");
        const Pose change = wall.motion->at(time).since(was.at(time));
        const Vector3 middle = axis ? axis->origin : Vector3();
        double jump = length(change(middle) - middle);
        constexpr double arm = 100;             // spacings: a drop's size
        for (const Vector3& away : {Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)}) jump = std::max(jump, arm * spacing * length(change.turned(away) - away));
        if (!(jump > most * spacing)) continue;
        std::ostringstream text;
        text << "it would jump by " << jump << " m at " << time << " s";
        refuse(wall.name, text.str());
    }
}

void Walls::useMotions(const Liquid& liquid, WallMotions motions)
{
    if (motions.body()) motions.body()->goOn(freeBody()->state());
    if (!motions.none()) bodies_ = WallBodies(std::move(motions), liquid.units());
}

void Walls::use(const Liquid& liquid, WallUse use)
{
    if (layer_) layer_->usePlanes(liquid, use.contactReach);
    closest_ = use.closest;
    useAngles(std::move(use.angles));
    useLaws(liquid);
}

bool Walls::oneContactAngle() const
{
    const auto [smallest, largest] = contactAngles();
    return largest - smallest < 0.01;                       // degrees
}

std::pair<double, double> Walls::contactAngles(scalar reach) const
{
    double tilt = 0;
    for (const WallSurface& surface : analytic_)
    {
        if (!surface.isFlat()) tilt = std::max(tilt, degrees(double(reach) / surface.radius));
    }
    const auto widened = [&](double least, double most)
    {
        return std::pair{std::max(least - tilt, 0.0), std::min(most + tilt, 180.0)};
    };
    double least = 180, most = 0;
    for (const auto* of : {angles_ ? &angles_->surfaces : nullptr, angles_ ? &angles_->particles : nullptr})
    {
        if (!of || of->empty()) continue;
        const auto [low, high] = std::minmax_element(of->begin(), of->end());
        least = std::min(least, *low);
        most = std::max(most, *high);
    }
    least = std::min(least, rangeOfLaws_.first);
    most = std::max(most, rangeOfLaws_.second);
    return least <= most ? widened(least, most) : widened(90, 90);
}

WallAngles Walls::readAngles() const
{
    WallAngles angles;
    if (layer_)
    {
        const auto folder = findInstance(case_, startTime_, "solid/theta");
        if (folder.empty())
        {
            throw FatalInputError
            (
                dict_.where(), "The solid particles have no contact angles: no time folder holds solid/theta",
                "run sampleTheta first"
            );
        }
        angles.particles = readTheta(folder, particles());
        refuseNoAngles(angles.particles, {(folder / "solid/theta").string(), 0});
    }
    if (surfaces_.count > 0)
    {
        // The entries of patches are sampleTheta's.
        const Dictionary wettability = Dictionary::read(case_ / "constant/wettability");
        std::vector<std::string> names = layer_ ? readSolidPatches(case_) : std::vector<std::string>();
        for (const std::string& patch : names)
        {
            if (wettability.found(patch)) wettability.subDict(patch).markUsed();
        }
        names.insert(names.end(), surfaceNames_.begin(), surfaceNames_.end());
        refuseUnknownWalls(wettability, names, case_);
        for (const std::string& wall : surfaceNames_) angles.surfaces.push_back(wallTheta(wettability, wall, case_));
        wettability.refuseUnused();
    }
    readLaws(angles);
    return angles;
}

void Walls::readLaws(WallAngles& angles) const
{
    angles.laws = LineLaws::read(case_, surfaceNames_, angles.surfaces, angles.particles);
}

void Walls::useAngles(std::optional<WallAngles> angles)
{
    angles_ = std::move(angles);
    for (int a = 0; angles_ && a < surfaces_.count; ++a) analytic_[a].cosTheta = cosine(angles_->surfaces[a]);
    giveSurfaces();
    giveCosines();
    wetted_ = contactAngles().first < 179.9;
}

// To kernels.
void Walls::giveSurfaces()
{
    surfaces_.count = int(analytic_.size());
    const auto few = analytic_.begin() + std::min(surfaces_.count, WallSurfacesView::few);
    std::copy(analytic_.begin(), few, surfaces_.surface);
    beyond_.upload(std::vector<WallSurface>(few, analytic_.end()));
    surfaces_.beyond = beyond_.span();
}

// To the solid particles.
void Walls::giveCosines()
{
    if (!layer_) return;
    std::vector<scalar> cosines;
    if (angles_) for (const double theta : angles_->particles) cosines.push_back(cosine(theta));
    layer_->useCosines(cosines, hasLaws() ? angles_->laws->particles : std::vector<std::uint32_t>());
}

// Tables of them; degrees become radians, and speeds scaled ones.
void Walls::useLaws(const Liquid& liquid)
{
    rangeOfLaws_ = {180, 0};
    if (!hasLaws()) return;
    const LineLaws& laws = *angles_->laws;
    const LiquidProperties& p = liquid.properties();
    const LineScales scales{p.spacing, p.density * p.viscosity, p.surfaceTension};
    rangeOfLaws_ = laws.range(scales);
    lawsFollowSpeed_ = laws.followSpeed(scales);
    std::vector<AngleLimits> table;
    std::vector<scalar> typical;
    for (const WallMaterial& material : laws.materials)
    {
        const double unit = material.typicalSpeed(scales);
        typical.push_back(liquid.units().toScaled(unit, dimensions::velocity));
        constexpr int side = LineLimitsView::side;
        const auto add = [&](double part, double sign)
        {
            const double speed = sign * unit * std::min(part / std::max(1 - part, 1e-9), 1e3);
            const auto [low, high] = material.limits(speed, scales);
            table.push_back({scalar(radians(low)), scalar(radians(high))});
        };
        for (int k = side; k >= 0; --k) add(double(k) / side, -1);
        for (int k = 0; k <= side; ++k) add(double(k) / side, 1);
    }
    limitTable_.upload(table);
    typicalSpeeds_.upload(typical);
    lawOfSurface_.upload(laws.surfaces);
}

LineLimitsView Walls::lineLimits() const
{
    return {limitTable_.span(), typicalSpeeds_.span(), lawOfSurface_.span(), layer_ ? layer_->laws() : Span<const std::uint32_t>{}};
}

void Walls::update(const Liquid& liquid)
{
    search(liquid);
    lengthen(liquid);
}

void Walls::search(const Liquid& liquid)
{
    if (!layer_) return;
    if (layer_->follow(liquid)) giveCosines();
    layer_->search(liquid);
}

void Walls::cut(const RowRectangle& rows, const CellGridView& cells)
{
    if (layer_) layer_->cut(rows, cells);
}

bool Walls::cutOff() { return layer_ && layer_->cutOff(); }

void Walls::lengthen(const Liquid& liquid)
{
    if (layer_) layer_->lengthen(liquid);
}

void Walls::project(Liquid& liquid) const
{
    if (surfaces_.count == 0 && particles() == 0) return;
    forEachTeam(liquid.owned(), KeepOutside{stop(liquid), liquid.predicted.span()});
}

WallStop Walls::stop(const Liquid& liquid) const
{
    return {view(liquid), liquid.support(), liquid.spacing(), closest_ * liquid.spacing(), liquid.position.span()};
}

void Walls::refuseLiquidInside(const Liquid& liquid) const
{
    const auto refuse = [&](int i, const std::string& wall, const SourceLocation& where)
    {
        throw FatalInputError
        (
            where, "Liquid particle " + std::to_string(liquid.id.download()[i]) + " at " + str(liquid.positions()[i])
          + " m is inside the solid '" + wall + "', or too near to it",
            "liquid half a spacing outside of every wall. A sampled one has its solid behind the faces of its surface: where all liquid is on that side, `flip yes;` in constant/walls turns them"
        );
    };
    if (const auto inside = liquidInside(liquid, surfaces_))
    {
        const std::string& name = surfaceNames_[inside->wall];
        refuse(inside->particle, name, dict_.where(name));
    }
    if (particles() == 0) return;
    const SolidParticles solid = readSolidParticles(case_, startTime_);
    if (const auto inside = liquidInside(liquid, solid)) refuse(inside->particle, solid.patches[inside->wall], dict_.where());
}

std::string Walls::solidAround(const Liquid& liquid) const
{
    if (const auto inside = liquidInside(liquid, surfaces_)) return surfaceNames_[inside->wall];
    if (particles() == 0) return {};
    const SolidParticles solid = readSolidParticles(case_, startTime_);
    const auto inside = liquidInside(liquid, solid);
    return inside ? solid.patches[inside->wall] : std::string();
}

WallView Walls::view(const Liquid& liquid) const
{
    const WallMotionView motion = bodies_.none() ? WallMotionView{}
        : WallMotionView{bodies_.dt(), bodies_.velocities(), layer_ ? layer_->velocities() : Span<const Vec3>{}, layer_ ? layer_->planeVelocities() : Span<const Vec3>{}};
    if (!layer_) return {{}, surfaces_, {}, liquid.position.span(), motion};
    return {layer_->view(), surfaces_, layer_->planes(), liquid.position.span(), motion};
}

}
