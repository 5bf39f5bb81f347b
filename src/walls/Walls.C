#include "walls/Walls.H"

#include "core/fieldFile/FieldFile.H"
#include "core/time/Time.H"
#include "device/Reduce.H"
#include "geometry/AnalyticSurface.H"
#include "geometry/NearestPoint.H"
#include "geometry/SolidParticles.H"
#include "geometry/thetaModels/ThetaField.H"
#include "particles/ParticleFiles.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace shizuku
{

namespace
{

// theta in degrees
float cosine(double theta)
{
    constexpr double degree = 3.14159265358979323846 / 180;
    return float(std::cos(theta * degree));
}

float cosineOf(double theta, const SourceLocation& where)
{
    if (theta >= 0 && theta <= 180) return cosine(theta);
    std::ostringstream text;
    text << "A contact angle of " << theta << " degrees";
    throw FatalInputError(where, text.str(), "0 to 180 degrees");
}

Vec3 scaled(const Vector3& v, double unit)
{
    return {float(v.x / unit), float(v.y / unit), float(v.z / unit)};
}

WallSurface curvedOrPlane(const AnalyticSurface& surface, double unit)
{
    using Type = AnalyticSurface::Type;
    const auto type = surface.type == Type::plane ? WallSurface::plane
        : surface.type == Type::sphere ? WallSurface::sphere : WallSurface::cylinder;
    return
    {
        type, scaled(surface.point, unit), scaled(surface.direction, 1), float(surface.radius / unit),
        surface.liquidInside ? -1.0f : 1.0f, 0
    };
}

// The six planes of a box that holds the liquid.
std::vector<WallSurface> facesOf(const AnalyticSurface& box, double unit)
{
    const Vec3 low = scaled(box.min, unit), high = scaled(box.max, unit);
    std::vector<WallSurface> faces;
    for (const Vec3 n : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    {
        faces.push_back({WallSurface::plane, low, n, 0, 1, 0});
        faces.push_back({WallSurface::plane, high, -n, 0, 1, 0});
    }
    return faces;
}

template<class Kernel>
struct VirtualVolume
{
    Kernel W;
    CellGridView grid;
    Span<const Vec3> position;
    Span<float> volume;

    HOST_DEVICE void operator()(int k) const
    {
        float sum = 0;
        grid.forEachCandidate(position[k], W.h, [&](int l) { sum += W.W(norm(position[k] - position[l])); });
        volume[k] = 1 / sum;
    }
};

// Of each cell of the solid particles' grid: whether any of them may be within reach of a place in it. Walls stay where they are:
// found once.
struct FindAround
{
    CellGridView grid;
    int cells;                              // that a search reaches, to either side
    Span<std::uint8_t> around;

    HOST_DEVICE void operator()(int cell) const
    {
        const int x = cell & ((1 << grid.bitsX) - 1), y = cell >> grid.bitsX & ((1 << grid.bitsY) - 1);
        const int z = cell >> (grid.bitsX + grid.bitsY);
        bool any = false;
        for (int k = z - cells; k <= z + cells && !any; ++k)
            for (int j = y - cells; j <= y + cells && !any; ++j)
                for (int i = x - cells; i <= x + cells && !any; ++i)
                {
                    const int key = int(grid.key(i, j, k));
                    any = grid.start[key + 1] > grid.start[key];
                }
        around[cell] = any;
    }
};

// The tangent plane of the layer near a liquid particle: the mean over the solid particles that are hardly farther than
// the nearest one, weighted by (1 - (r^2 - r_min^2)/(2d)^2)^2. With n the direction of their mean normal the height above
// the layer is H = <(n_k + n).r_k>/<1 + n_k.n>, exact before planes and spheres: there r_k = (R + H) e - R n_k. The layer lies
// half a spacing inside the solid. Beside the border of a layer there is no wall.
struct FitPlane
{
    float spacing, listed, reach;           // listed: up to which distance the lists know
    Span<const Vec3> x;
    CellGridView grid;                      // of the solid particles
    Span<const std::uint8_t> around;        // FindAround
    WallParticlesView solid;
    Span<Vec3> normal;
    Span<float> offset, cosTheta;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Vec3 xi = x[i];
        const float most = reach * reach;
        float nearest = most;
        const auto come = [&](int k) { nearest = fminf(nearest, squared(xi - solid.position[k])); };
        solid.near.forEach(i, come, team);
        nearest = team.min(nearest);
        if (nearest == most && around[int(grid.key(xi))])
        {
            grid.forEachCandidate(xi, reach, come, team);
            nearest = team.min(nearest);
        }
        Vec3 direction, from;
        float along = 0, cosine = 0, total = 0;
        const auto add = [&](int k)
        {
            const Vec3 r = xi - solid.position[k];
            const float w = 1 - (squared(r) - nearest) / (4 * spacing * spacing);
            if (w <= 0 || squared(r) >= most) return;
            const float weight = w * w;
            total += weight;
            direction += weight * solid.normal[k];
            from += weight * r;
            along += weight * dot(solid.normal[k], r);
            cosine += weight * (solid.cosTheta.size > 0 ? solid.cosTheta[k] : 0);
        };
        const float within = nearest + 4 * spacing * spacing;
        if (within <= listed * listed) solid.near.forEach(i, add, team);
        else if (nearest < most) grid.forEachCandidate(xi, sqrtf(fminf(within, most)), add, team);
        total = team.sum(total);
        direction = team.sum(direction);
        from = team.sum(from);
        along = team.sum(along);
        cosine = team.sum(cosine);
        if (!team.first()) return;
        const float length = norm(direction);
        normal[i] = {0, 0, 1};
        offset[i] = WallPlanesView::nowhere;
        cosTheta[i] = 0;
        if (total == 0 || length < 1e-6f * total) return;

        const Vec3 n = (1 / length) * direction;
        const float height = (along + dot(n, from)) / (total + length);
        if (nearest - height * height > 2.25f * spacing * spacing) return;
        normal[i] = n;
        offset[i] = dot(n, xi) - (height - 0.5f * spacing);
        cosTheta[i] = cosine / total;
    }
};

// Where surfaces and tangent planes let the liquid be; then where layers of solid particles do.
//
// The layer's height below a liquid particle is the average over the solid particles around it, r.n weighted by distance
// (B. Adams and M. Wicke, Eurographics tutorial 2009). Where their normals cancel, in a plate as thin as the layer itself,
// no side is the inner one; where none of them is below the particle, it is beside the layer's border. No more is taken back
// than this step came nearer: around sharp edges the average height jumps, and what followed it would gain speed.
struct KeepOutside
{
    WallView walls;
    float support, spacing;
    Span<const Vec3> position;
    Span<Vec3> predicted;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Vec3 before = predicted[i];
        const float closest = 0.5f * spacing;
        Vec3 x = before;
        bool moved = false;
        walls.forEachContact(i, before, closest, [&](int, const WallContact& contact)
        {
            x += (closest - contact.distance) * contact.normal;
            moved = true;
        });
        const Vec3 back = fromLayer(i, x, moved, team);
        if (moved && team.first()) predicted[i] = x + back;
    }

    // How far the particle at x has to go; sets `moved` where it has to.
    HOST_DEVICE Vec3 fromLayer(int i, Vec3 x, bool& moved, Team team) const
    {
        float weights = 0, height = 0, aside = spacing * spacing;
        Vec3 normal;
        const WallParticlesView& wall = walls.particles;
        wall.near.forEach(i, [&](int k)
        {
            const Vec3 r = x - wall.position[k], n = wall.normal[k];
            const float q = 1 - squared(r) / (support * support);
            if (q <= 0) return;
            const float along = dot(r, n);
            weights += q * q * q;
            height += q * q * q * along;
            normal += q * q * q * n;
            aside = fminf(aside, squared(r) - along * along);
        }, team);
        aside = team.min(aside);
        weights = team.sum(weights);
        height = team.sum(height);
        normal = team.sum(normal);
        if (aside >= spacing * spacing) return {};
        const float lacking = 0.25f * spacing - height / weights, agreement = norm(normal) / weights;
        if (lacking <= 0 || agreement < 0.5f) return {};
        const Vec3 outwards = (1 / norm(normal)) * normal;
        moved = true;
        return fminf(lacking, fmaxf(0, dot(position[i] - x, outwards))) * outwards;
    }
};

// The first particle that is too near to a surface, or behind it, and the first such surface.
struct FirstInside
{
    static constexpr int none = std::numeric_limits<int>::max();

    int particle = none, surface = 0;

    HOST_DEVICE void add(const FirstInside& other)
    {
        if (other.particle < particle) *this = other;
    }
};

struct InsideSurface
{
    WallSurfacesView surfaces;
    float nearest;                  // distance that is far enough
    Span<const Vec3> position;

    HOST_DEVICE FirstInside operator()(int i) const
    {
        for (int a = 0; a < surfaces.count; ++a)
        {
            if (surfaces.surface[a](position[i]).distance < nearest) return {i, a};
        }
        return {};
    }
};

}

void WallCosines::setParticles(const std::vector<double>& theta)
{
    particles.clear();
    for (const double angle : theta) particles.push_back(cosine(angle));
}

Walls::Walls(const std::filesystem::path& casePath, double startTime, const Liquid& liquid)
:
    case_(casePath), startTime_(startTime), dict_(Dictionary::read(casePath / "constant/walls")),
    sampled_(useSolidParticles(casePath))
{
    for (const AnalyticSurface& surface : readAnalyticSurfaces(dict_))
    {
        const double unit = liquid.units().length;
        const auto faces = surface.type == AnalyticSurface::Type::box
            ? facesOf(surface, unit) : std::vector{curvedOrPlane(surface, unit)};
        if (surfaces_.count + int(faces.size()) > WallSurfacesView::most)
        {
            throw FatalInputError
            (
                dict_.where(surface.name), "Too many analytic walls",
                "at most " + std::to_string(WallSurfacesView::most) + " surfaces; a box counts as six"
            );
        }
        for (const WallSurface& face : faces)
        {
            surfaces_.surface[surfaces_.count++] = face;
            surfaceNames_.push_back(surface.name);
            if (face.type == WallSurface::plane) held_.hold(face.direction);
            else held_.holdAll();
        }
    }
    if (surfaces_.count > 0)
    {
        halfSpace_.upload(tabulateHalfSpace(liquid.kernel()));
        surfaces_.halfSpace = {halfSpace_.span(), liquid.support()};
    }
    if (sampled_) readParticles(liquid);
    dict_.refuseUnused();
}

void Walls::readParticles(const Liquid& liquid)
{
    auto& fields = solid_.fields();
    position_ = &fields.add<Vec3>({.name = "positions", .dimensions = dimensions::length, .restarted = true});
    normal_ = &fields.add<Vec3>({.name = "normals", .dimensions = dimensions::none, .restarted = true});
    volume_ = &fields.add<float>({.name = "volume", .dimensions = dimensions::volume});

    const auto folder = case_ / "constant/solid";
    if (!std::filesystem::exists(folder / "positions"))
    {
        throw FatalInputError
        (
            dict_.where(), "There are no solid particles for the walls of type particles: "
          + (folder / "positions").string() + " is missing", "run sampleSurface first"
        );
    }
    shizuku::readParticles(solid_, liquid.units(), folder);
    for (const Vec3& n : normal_->download()) held_.hold(n);

    std::vector<std::uint32_t> order(solid_.all());
    std::iota(order.begin(), order.end(), 0u);
    order_.upload(order);
    sortParticles(liquid, liquid.support(), liquid.support());
    computeVirtualVolumes(liquid);
}

void Walls::sortParticles(const Liquid& liquid, float support, float reach)
{
    // A search reaches two cells at most, a little less than that.
    const float cell = std::max(support, 0.501f * reach);
    grid_.emplace(cell, reach);
    // Rows for a fifth more than what a flat layer, a triangular lattice, has within the support.
    const float supports = support / liquid.spacing();
    near_.emplace(support, int(1.2f * 3.63f * supports * supports));
    reach_ = reach;
    const Buffer<std::uint32_t>& order = grid_->build(position_->span(), solid_.all());
    solid_.fields().reorder(order);
    std::vector<std::uint32_t> now = order.download();
    const auto before = order_.download();
    for (std::uint32_t& k : now) k = before[k];
    order_.upload(now);
    const CellGridView view = grid_->view();
    around_.resizeDiscarding(view.start.size - 1);
    forEach(around_.size(), FindAround{view, reach > cell ? 2 : 1, around_.span()});
}

void Walls::requireContacts(const Liquid& liquid, float reach)
{
    contacts_ = true;
    // From the layer, half a spacing inside of the solid, with room for the patch that gives the plane.
    const float wanted = reach + 1.5f * liquid.spacing();
    // Particles move, by less than half a spacing, after the lists are made.
    const float support = liquid.support() + 0.5f * liquid.spacing();
    if (solid_.all() > 0 && wanted > reach_) sortParticles(liquid, support, wanted);
}

bool Walls::oneContactAngle() const
{
    const auto [smallest, largest] = contactAngles();
    return largest - smallest < 0.01;                       // degrees
}

std::pair<double, double> Walls::contactAngles(float reach) const
{
    constexpr double degree = 3.14159265358979323846 / 180;
    double tilt = 0;
    for (int a = 0; a < surfaces_.count; ++a)
    {
        const WallSurface& surface = surfaces_.surface[a];
        if (surface.type != WallSurface::plane) tilt = std::max(tilt, double(reach / surface.radius) / degree);
    }
    const auto widened = [&](double least, double most)
    {
        return std::pair{std::max(least - tilt, 0.0), std::min(most + tilt, 180.0)};
    };
    if (!cosTheta_) return widened(90, 90);
    std::vector<float> cosines = cosTheta_->download();
    for (int a = 0; a < surfaces_.count; ++a) cosines.push_back(surfaces_.surface[a].cosTheta);
    if (cosines.empty()) return widened(90, 90);
    const auto [least, most] = std::minmax_element(cosines.begin(), cosines.end());
    return widened(std::acos(double(*most)) / degree, std::acos(double(*least)) / degree);
}

// Equation (9) with equal masses: V_k = 1/sum_l W(x_k - x_l), l = k included.
void Walls::computeVirtualVolumes(const Liquid& liquid)
{
    std::visit
    (
        [&](const auto& W) { forEach(solid_.all(), VirtualVolume{W, grid_->view(), position_->span(), volume_->span()}); },
        liquid.kernel()
    );
}

void Walls::requireContactAngles()
{
    if (!cosTheta_ && (sampled_ || surfaces_.count > 0)) use(readCosines(startTime_));
}

WallCosines Walls::readCosines(double time) const
{
    WallCosines cosines;
    if (sampled_)
    {
        const auto folder = findInstance(case_, time, "solid/theta");
        if (folder.empty())
        {
            throw FatalInputError
            (
                dict_.where(), "The solid particles have no contact angles: no time folder holds solid/theta",
                "run sampleTheta first"
            );
        }
        const auto file = folder / "solid/theta";
        const FieldData theta = readField(file, FieldType::scalar, dimensions::none, solid_.all());
        for (int k = 0; k < solid_.all(); ++k) cosines.particles.push_back(cosineOf(theta(k), {file.string(), 0}));
    }
    if (surfaces_.count > 0)
    {
        // The entries of patches are sampleTheta's.
        const Dictionary wettability = Dictionary::read(case_ / "constant/wettability");
        std::vector<std::string> names = sampled_ ? readSolidPatches(case_) : std::vector<std::string>();
        for (const std::string& patch : names)
        {
            if (wettability.found(patch)) wettability.subDict(patch).markUsed();
        }
        names.insert(names.end(), surfaceNames_.begin(), surfaceNames_.end());
        refuseUnknownWalls(wettability, names);
        for (const std::string& wall : surfaceNames_) cosines.surfaces.push_back(cosine(wallTheta(wettability, wall)));
        wettability.refuseUnused();
    }
    return cosines;
}

void Walls::use(const WallCosines& cosines)
{
    if (!cosTheta_) cosTheta_ = &solid_.fields().add<float>({.name = "cosTheta", .dimensions = dimensions::none});
    for (int a = 0; a < surfaces_.count; ++a) surfaces_.surface[a].cosTheta = cosines.surfaces[a];
    if (!sampled_) return;
    const auto order = order_.download();
    std::vector<float> sorted(order.size());
    for (std::size_t k = 0; k < sorted.size(); ++k) sorted[k] = cosines.particles[order[k]];
    cosTheta_->upload(sorted);
}

std::optional<WallCosines> Walls::cosines() const
{
    if (!cosTheta_) return {};
    WallCosines cosines;
    for (int a = 0; a < surfaces_.count; ++a) cosines.surfaces.push_back(surfaces_.surface[a].cosTheta);
    if (!sampled_) return cosines;
    const auto order = order_.download();
    const auto sorted = cosTheta_->download();
    cosines.particles.resize(sorted.size());
    for (std::size_t k = 0; k < sorted.size(); ++k) cosines.particles[order[k]] = sorted[k];
    return cosines;
}

void Walls::update(const Liquid& liquid)
{
    if (solid_.all() == 0) return;
    near_->build(liquid.predicted.span(), liquid.owned(), *grid_, position_->span(), false);
    if (!contacts_) return;
    planeNormal_.resizeDiscarding(liquid.all());
    planeOffset_.resizeDiscarding(liquid.all());
    planeCosTheta_.resizeDiscarding(liquid.all());
    forEachTeam(liquid.owned(), FitPlane
    {
        liquid.spacing(), near_->support(), reach_, liquid.predicted.span(), grid_->view(), around_.span(),
        view().particles, planeNormal_.span(), planeOffset_.span(), planeCosTheta_.span()
    });
}

void Walls::project(Liquid& liquid) const
{
    if (surfaces_.count == 0 && solid_.all() == 0) return;
    forEachTeam
    (
        liquid.owned(),
        KeepOutside{view(), liquid.support(), liquid.spacing(), liquid.position.span(), liquid.predicted.span()}
    );
}

void Walls::refuseLiquidInside(const Liquid& liquid) const
{
    const auto refuse = [&](const Vector3& x, int i, const std::string& wall, const SourceLocation& where)
    {
        throw FatalInputError
        (
            where, "Liquid particle " + std::to_string(i) + " at " + str(x) + " m is inside the solid '" + wall
          + "', or too near to it", "liquid half a spacing outside of every wall"
        );
    };
    const double unit = liquid.units().length;
    if (surfaces_.count > 0)
    {
        Buffer<FirstInside> scratch;
        const InsideSurface inside{surfaces_, 0.25f * liquid.spacing(), liquid.position.span()};
        const FirstInside first = reduce(liquid.owned(), inside, scratch);
        if (first.particle != FirstInside::none)
        {
            const Vec3 x = liquid.position.download()[first.particle];
            const std::string& name = surfaceNames_[first.surface];
            refuse({x.x * unit, x.y * unit, x.z * unit}, first.particle, name, dict_.where(name));
        }
    }
    if (solid_.all() == 0) return;

    const SolidParticles solid = readSolidParticles(case_);
    const NearestPoint nearest(solid.positions);
    const double d = liquid.properties().spacing;
    const auto positions = liquid.position.download();
    for (int i = 0; i < liquid.owned(); ++i)
    {
        const Vector3 x(positions[i].x * unit, positions[i].y * unit, positions[i].z * unit);
        const std::size_t k = nearest(x);
        const Vector3 r = x - solid.positions[k];
        const double height = dot(r, solid.normals[k]);
        // Behind the layer; but not beside its border, where the nearest particle is far off to one side.
        const bool behind = height < 0 && squaredLength(r) - height * height < d * d;
        if (behind || squaredLength(r) < 0.25 * d * d) refuse(x, i, solid.patches[solid.patch[k]], dict_.where());
    }
}

WallView Walls::view() const
{
    WallView view;
    view.surfaces = surfaces_;
    if (solid_.all() > 0)
    {
        view.particles =
        {
            near_->view(), position_->span(), normal_->span(), volume_->span(),
            cosTheta_ ? Span<const float>(cosTheta_->span()) : Span<const float>{}
        };
        if (contacts_) view.planes = {planeNormal_.span(), planeOffset_.span(), planeCosTheta_.span()};
    }
    return view;
}

}
