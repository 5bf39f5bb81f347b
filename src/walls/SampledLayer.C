// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/SampledLayer.H"

#include "device/ForEach.H"
#include "neighbours/MarkRows.H"
#include "particles/ParticleFiles.H"
#include "walls/ConvexEdges.H"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace shizuku
{

namespace
{

template<class Kernel>
struct VirtualVolume
{
    Kernel W;
    CellGridView grid;
    Span<const Position> position;
    Span<const std::uint32_t> body;     // may be empty: all are of one
    Span<scalar> volume;

    HOST_DEVICE void operator()(int k) const
    {
        scalar sum = 0;
        grid.forEachCandidate(AroundPoint{position[k], W.h}, [&](int l)
        {
            if (body.size > 0 && body[l] != body[k]) return;
            if (isSameImage(position[k], position[l])) sum += W.W(norm(position[k] - position[l]));
        });
        volume[k] = 1 / sum;
    }
};

constexpr std::uint32_t atRest = ~std::uint32_t(0);        // is its body

struct MoveParticle
{
    Span<const BodyPose> poses;
    Span<const BodyVelocity> velocities;
    Span<const std::uint32_t> body;
    Span<const Position> from;
    Span<const Vec3> normalFrom;
    Span<Position> position;
    Span<Vec3> normal, velocity;

    HOST_DEVICE void operator()(int k) const
    {
        if (body[k] == atRest) return;
        const int b = int(body[k]);
        const Place at = poses[b](placeOf(from[k]));
        position[k] = positionAt(at);
        normal[k] = poses[b].turned(normalFrom[k]);
        velocity[k] = velocities[b](at);
    }
};

template<class T>
std::vector<T> chosen(const std::vector<T>& values, const std::vector<std::uint32_t>& from)
{
    std::vector<T> result;
    result.reserve(from.size());
    for (const std::uint32_t k : from) result.push_back(values[k]);
    return result;
}

}

SampledLayer::SampledLayer(const std::filesystem::path& casePath, const SourceLocation& asked, const Liquid& liquid)
:
    folder_(casePath / "constant/solid"),
    position_(solid_.fields().add<Position>({.name = "positions", .dimensions = dimensions::length, .restarted = true, .begins = true})),
    normal_(solid_.fields().add<Vec3>({.name = "normals", .dimensions = dimensions::none, .restarted = true, .begins = true})),
    volume_(solid_.fields().add<scalar>({.name = "volume", .dimensions = dimensions::volume})),
    order_(solid_.fields().add<std::uint32_t>({.name = "order", .dimensions = dimensions::none}))
{
    if (!std::filesystem::exists(folder_ / "positions"))
    {
        throw FatalInputError
        (
            asked, "There are no solid particles for the walls of type particles: "
          + (folder_ / "positions").string() + " is missing", "run sampleSurface first"
        );
    }
    read(liquid);
}

// All of them.
void SampledLayer::read(const Liquid& liquid)
{
    all_ = int(readParticles(solid_, liquid.units(), folder_));
    std::vector<std::uint32_t> order(solid_.all());
    std::iota(order.begin(), order.end(), 0u);
    order_.upload(order);
    sort(liquid, liquid.support(), liquid.support());
    computeVirtualVolumes(liquid);
    findEdges(liquid);
}

void SampledLayer::sort(const Liquid& liquid, scalar support, scalar reach)
{
    // A search reaches two cells at most, a little less than that.
    grid_.emplace(std::max(support, 0.501f * reach), reach);
    // Rows for a fifth more than what a flat layer, a triangular lattice, has within the support.
    const scalar supports = support / liquid.spacing();
    near_.emplace(support, int(1.2f * 3.63f * supports * supports));
    reach_ = reach;
    sortAnew();
}

void SampledLayer::sortAnew()
{
    solid_.fields().reorder(grid_->build(std::as_const(position_).span(), solid_.all(), std::as_const(order_).span()));
}

void SampledLayer::setBodies(const std::vector<int>& bodies, const Liquid& liquid)
{
    FieldRegistry& fields = solid_.fields();
    moving_.emplace(Moving
    {
        fields.add<std::uint32_t>({.name = "body", .dimensions = dimensions::none}), fields.add<Position>({.name = "place", .dimensions = dimensions::length}),
        fields.add<Vec3>({.name = "normal", .dimensions = dimensions::none}), fields.add<Vec3>({.name = "velocity", .dimensions = dimensions::velocity})
    });
    std::vector<std::uint32_t> body;
    for (const int b : chosen(bodies, order_.download())) body.push_back(b < 0 ? atRest : std::uint32_t(b));
    moving_->body.upload(body);
    moving_->position.upload(position_.download());
    moving_->normal.upload(normal_.download());
    computeVirtualVolumes(liquid);
    findEdges(liquid);
}

void SampledLayer::move(const WallBodies& bodies)
{
    if (!moving_ || solid_.all() == 0) return;
    forEach(solid_.all(), MoveParticle
    {
        bodies.poses(), bodies.velocities(), std::as_const(moving_->body).span(), std::as_const(moving_->position).span(),
        std::as_const(moving_->normal).span(), position_.span(), normal_.span(), moving_->velocity.span()
    });
    sortAnew();
    if (planes_) planes_.emplace(grid_->view(), reach_, true);
}

// Lets go of all others, but for one where that are all, so that there is a layer in every part.
void SampledLayer::keep(const RowRectangle& rows)
{
    Buffer<std::uint8_t> is(solid_.all());
    forEach(solid_.all(), MarkRows{cut_->cells, rows, true, std::as_const(position_).span(), is.span()});
    const std::vector<std::uint8_t> stays = is.download();
    std::vector<std::uint32_t> kept;
    for (std::size_t k = 0; k < stays.size(); ++k) if (stays[k]) kept.push_back(std::uint32_t(k));
    if (kept.empty()) kept.push_back(0);
    solid_.fields().reorder(Buffer<std::uint32_t>(kept));
    solid_.resize(int(kept.size()));
}

bool SampledLayer::follow(const Liquid& liquid)
{
    if (!cut_ || solid_.all() == 0) return false;
    constexpr int margin = 4;                   // rows: so far cuts move without files being read
    const scalar support = near_->support(), reach = reach_;
    const RowRectangle wanted = cut_->rows.widened(int(std::ceil(1.001f * std::max(support, reach) * cut_->cells.perCell)));
    if (held_ && held_->covers(wanted)) return false;
    if (held_)
    {
        const int before = all_;
        read(liquid);
        if (all_ != before) throw FatalError("The solid particles in " + folder_.string() + " are others than when the run began: " + std::to_string(all_) + ", not " + std::to_string(before));
    }
    held_ = wanted.widened(margin);
    keep(*held_);
    sort(liquid, support, reach);
    if (planes_) planes_.emplace(grid_->view(), reach, false);
    return true;
}

void SampledLayer::computeVirtualVolumes(const Liquid& liquid)
{
    std::visit
    (
        [&]<class Kernel>(const Kernel& W)
        {
            forEach(solid_.all(), VirtualVolume<Kernel>{W, grid_->view(), position_.span(), bodies(), volume_.span()});
        },
        liquid.kernel()
    );
}

// They turn with their particles, so they are found once.
void SampledLayer::findEdges(const Liquid& liquid)
{
    Buffer<scalar> sharpness(solid_.all());
    forEach(solid_.all(), FindConvexEdges{liquid.spacing(), grid_->view(), position_.span(), normal_.span(), bodies(), sharpness.span()});
    const std::vector<scalar> values = sharpness.download();
    if (!sharpness_ && std::all_of(values.begin(), values.end(), [](scalar s) { return s == 0; })) return;
    if (!sharpness_) sharpness_ = &solid_.fields().add<scalar>({.name = "edge", .dimensions = dimensions::none});
    sharpness_->upload(values);
}

void SampledLayer::constrain(WallConstraints& constraints) const
{
    for (const Vec3& n : normal_.download()) constraints.constrain(n);
}

void SampledLayer::usePlanes(const Liquid& liquid, scalar reach)
{
    if (solid_.all() == 0) return;
    planes_.reset();
    // From the layer, half a spacing inside of the solid, with room for the patch that gives the plane.
    const scalar wanted = reach > 0 ? reach + 1.5f * liquid.spacing() : 0;
    // Beside edges sums go over all solid particles within reach of the surface, half a spacing before them (freeSurface/SampledEdges.H).
    const scalar halfSpacing = 0.5f * liquid.spacing(), ofSums = sharpness_ ? std::max(liquid.support(), reach + halfSpacing) : liquid.support();
    // Particles move, by less than half a spacing, after the lists are made.
    if (wanted > liquid.support()) sort(liquid, ofSums + halfSpacing, wanted);
    else sort(liquid, liquid.support(), liquid.support());
    if (reach > 0) planes_.emplace(grid_->view(), reach_, moving_.has_value());
}

void SampledLayer::useCosines(const std::vector<scalar>& cosines, const std::vector<std::uint32_t>& laws)
{
    const std::vector<std::uint32_t> order = order_.download();
    if (!laws.empty() && !laws_) laws_ = &solid_.fields().add<std::uint32_t>({.name = "law", .dimensions = dimensions::none});
    if (!laws.empty()) laws_->upload(chosen(laws, order));
    anglesInUse_ = !cosines.empty();
    if (!anglesInUse_) return;
    if (!cosTheta_) cosTheta_ = &solid_.fields().add<scalar>({.name = "cosTheta", .dimensions = dimensions::none});
    cosTheta_->upload(chosen(cosines, order));
}

void SampledLayer::search(const Liquid& liquid)
{
    if (solid_.all() == 0) return;
    near_->search(liquid.predicted.span(), liquid.owned(), *grid_, position_.span(), false);
    fitPlanes(liquid);
}

bool SampledLayer::cutOff() { return solid_.all() > 0 && near_->cutOff(); }

void SampledLayer::lengthen(const Liquid& liquid)
{
    if (!cutOff()) return;
    near_->lengthen(liquid.predicted.span(), liquid.owned(), *grid_, position_.span(), false);
    fitPlanes(liquid);
}

void SampledLayer::fitPlanes(const Liquid& liquid)
{
    if (planes_) planes_->fit(liquid, grid_->view(), view(), {velocities(), sharpness_ ? std::as_const(*sharpness_).span() : Span<const scalar>{}}, near_->support());
}

WallParticlesView SampledLayer::view() const
{
    if (solid_.all() == 0) return {};
    return
    {
        near_->view(), position_.span(), normal_.span(), volume_.span(),
        anglesInUse_ ? Span<const scalar>(cosTheta_->span()) : Span<const scalar>{}
    };
}

}
