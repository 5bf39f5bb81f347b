#include "walls/Walls.H"

#include "core/fieldFile/FieldFile.H"
#include "core/time/Time.H"
#include "geometry/AnalyticSurface.H"
#include "particles/ParticleFiles.H"

#include <cmath>

namespace shizuku
{

namespace
{

constexpr double degree = 3.14159265358979323846 / 180;

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
        grid.forEachCandidate(position[k], [&](int l) { sum += W.W(norm(position[k] - position[l])); });
        volume[k] = 1 / sum;
    }
};

struct KeepOutside
{
    WallSurfacesView surfaces;
    float closest;
    Span<Vec3> predicted;

    HOST_DEVICE void operator()(int i) const
    {
        for (int a = 0; a < surfaces.count; ++a)
        {
            const auto place = surfaces.surface[a](predicted[i]);
            if (place.distance < closest) predicted[i] += (closest - place.distance) * place.normal;
        }
    }
};

}

Walls::Walls(const std::filesystem::path& casePath, double startTime, const Liquid& liquid)
:
    case_(casePath), startTime_(startTime), dict_(Dictionary::read(casePath / "constant/walls"))
{
    for (const std::string& name : dict_.keys())
    {
        sampled_ = sampled_ || (dict_.isDict(name) && dict_.subDict(name).lookup<std::string>("type") == "particles");
    }
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

    grid_.emplace(liquid.support());
    near_.emplace(liquid.support());
    const Buffer<std::uint32_t>& order = grid_->build(position_->span(), solid_.all());
    fields.reorder(order);
    order_.upload(order.download());
    computeVirtualVolumes(liquid);
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
    if (cosTheta_ || (!sampled_ && surfaces_.count == 0)) return;

    cosTheta_ = &solid_.fields().add<float>({.name = "cosTheta", .dimensions = dimensions::none});
    if (sampled_)
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
        const FieldData theta = readField(folder / "solid/theta", FieldType::scalar, dimensions::none, solid_.all());
        const auto order = order_.download();
        std::vector<float> cosines(solid_.all());
        for (int k = 0; k < solid_.all(); ++k) cosines[k] = float(std::cos(theta(order[k]) * degree));
        cosTheta_->upload(cosines);
    }
    if (surfaces_.count > 0)
    {
        const Dictionary wettability = Dictionary::read(case_ / "constant/wettability");
        for (int a = 0; a < surfaces_.count; ++a)
        {
            const Dictionary wall = wettability.subDict(surfaceNames_[a]);
            const double theta = wall.lookup<double>("theta");
            if (!(theta >= 0 && theta <= 180))
            {
                throw FatalInputError
                (
                    wall.where("theta"), "A contact angle of " + std::to_string(theta) + " degrees", "0 to 180 degrees"
                );
            }
            surfaces_.surface[a].cosTheta = float(std::cos(theta * degree));
        }
    }
}

void Walls::update(const Liquid& liquid)
{
    if (solid_.all() > 0) near_->build(liquid.predicted.span(), liquid.owned(), *grid_, position_->span(), false);
}

void Walls::project(Liquid& liquid) const
{
    if (surfaces_.count > 0)
    {
        forEach(liquid.owned(), KeepOutside{surfaces_, 0.5f * liquid.spacing(), liquid.predicted.span()});
    }
}

void Walls::refuseLiquidInside(const Liquid& liquid) const
{
    if (surfaces_.count == 0) return;
    const auto positions = liquid.position.download();
    for (int i = 0; i < liquid.owned(); ++i)
    {
        for (int a = 0; a < surfaces_.count; ++a)
        {
            const float distance = surfaces_.surface[a](positions[i]).distance;
            if (distance < 0.25f * liquid.spacing())
            {
                throw FatalInputError
                (
                    dict_.where(surfaceNames_[a]),
                    "Liquid particle " + std::to_string(i) + " lies inside the solid '" + surfaceNames_[a]
                  + "' or nearer than a quarter of a spacing to it: distance "
                  + std::to_string(liquid.units().toSI(distance, dimensions::length)) + " m",
                    "liquid half a spacing outside of every wall"
                );
            }
        }
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
    }
    return view;
}

}
