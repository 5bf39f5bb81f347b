// SPDX-License-Identifier: GPL-3.0-or-later
#include "freeSurface/FreeSurface.H"

#include "device/Algorithms.H"
#include "device/Atomic.H"
#include "device/Holds.H"
#include "device/KeptMemory.H"
#include "freeSurface/FindContactLine.H"
#include "maths/EvenTable.H"
#include "maths/Lattice.H"
#include "particles/NeighbourLoop.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// Tells the particles at the surface: those that have few neighbours, and those whose neighbours lie on one side. The second is asked where the first leaves
// a doubt: in close-packed layers a particle at the surface has as many neighbours as one deep inside of other lattices.
struct FindExposed
{
    Span<const Position> x;
    NeighbourView near;
    std::uint32_t fewest, most;             // neighbours: at the surface below the one; not from the other on
    scalar support;
    scalar leastMean;                       // how far the mean place of the neighbours is away where they lie on one side
    Span<std::uint8_t> isExposed;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const std::uint32_t count = near.count[i];
        Team::Vector sum;
        if (count >= fewest && count < most) near.forEach(i, x[i], x, [&](auto, auto r) { sum += (squared(r) < support * support ? scalar(1) : scalar(0)) * r; }, team);
        const Vec3 all = team.sum(sum);
        if (team.first()) isExposed[i] = count < fewest || norm(all) > leastMean * count;
    }
};

// Tells the particles near the surface from those deep inside, all around which there is liquid that has liquid all around:
// the surface is farther than the density's support.
struct FindSurface
{
    NeighbourView near;
    Span<const std::uint8_t> isExposed;     // of ghosts too
    Span<std::uint8_t> isNear;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        scalar open = isExposed[i];
        near.forEach(i, [&](int j) { if (isExposed[j]) open = 1; }, team);
        open = team.sum(open);
        if (team.first()) isNear[i] = open > 0;
    }
};

// Until the walls' part is added, the liquid's part in the colour stands beside that in the gradient.
HOST_DEVICE inline Vec3 withColour(Vec3 G, scalar colour)
{
    G.w = colour;
    return G;
}
HOST_DEVICE inline scalar colourBeside(Vec3 G) { return G.w; }

// The liquid's part in the colour and its gradient.
template<class Search>
struct SumColour
{
    WendlandC2 W;
    scalar volume;                          // V/S
    Search wide;
    Span<const std::uint32_t> selected;
    Span<Vec3> gradient;                    // with the colour

    HOST_DEVICE void operator()(Group places, Team team) const
    {
        GroupOfParticles group;
        group.members = places.members();
        #pragma unroll
        for (int p = 0; p < Group::most; ++p) group.index[p] = int(selected[places[p]]);
        Team::Scalar values[Group::most] = {};
        Team::Vector slopes[Group::most];
        wide.forEach(group, [](auto) { return 0; }, [&](int p, int, auto r)
        {
            const auto distance = norm(r);
            values[p] += W.W(distance);
            slopes[p] += W.g(distance) * r;
        }, team);
        const scalar sum = team.sums(values);
        const Vec3 G = team.sums(slopes);
        if (team.lane >= places.size) return;
        const int k = places.first + team.lane;
        gradient[k] = withColour({volume * G.x, volume * G.y, volume * G.z}, volume * (W.W(0) + sum));
    }
};

// Adds the walls, and reads the depth. The lanes of a team share what is tried at contact lines.
struct Reconstruct
{
    static constexpr Holds holds = Holds::much;

    Span<const Position> x;
    FindContactLine findContactLine;
    Span<const scalar> depthOfRatio;
    scalar largestRatio, suction;
    Span<const std::uint32_t> place;
    Span<Vec3> gradient;
    Span<scalar> depth;
    Span<Position> position;
    Span<ContactLine> contact;              // empty: none has been found so far
    Span<std::uint32_t> any;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const int k = int(place[i]);
        const Position xi = x[i];
        Vec3 G = gradient[k];
        scalar colour = colourBeside(G);
        const WallContribution& completion = findContactLine.completion;
        // Liquid on the other side of an edge is behind the tangent plane, where the wall's extension is.
        const auto beyond = completion.beyondEdges(i, xi);
        colour += beyond.value;
        G += beyond.gradient;
        const ContactLine line = findContactLine(i, xi, colour, G, team);
        const auto wall = completion.ofPlanes(i, xi, line, team);
        if (!team.first()) return;
        colour += wall.value;
        G += wall.gradient;
        if (contact.size > 0) contact[k] = line;
        else if (line.wall >= 0) put(any[0], 1u);
        gradient[k] = withLowestPressure(G, -suction);
        const scalar s = depthOf(norm(G) / colour * completion.h);
        depth[k] = s;
        position[k] = withDepth(xi, s);
    }

private:
    // What has no number is not deep.
    HOST_DEVICE scalar depthOf(scalar ratio) const
    {
        return valueAt(depthOfRatio, ratio < largestRatio ? ratio / largestRatio : 1);
    }
};

// q h at the depth s below a planar surface.
scalar ratioAt(const HalfSpaceView& plane, scalar s) { return plane.h * plane(s).gradient / (1 - plane(s).density); }

// s at evenly spaced q h from 0 to that of the shallowest: on the way there from deep inside it grows.
std::vector<scalar> tabulateDepths(const HalfSpaceView& plane, scalar shallowest)
{
    const scalar largest = ratioAt(plane, shallowest);
    constexpr int n = 256;
    std::vector<scalar> depths(n + 1);
    for (int k = 0; k <= n; ++k)
    {
        scalar low = shallowest, high = plane.h;
        for (int step = 0; step < 40; ++step)
        {
            const scalar s = 0.5f * (low + high);
            (ratioAt(plane, s) > largest * scalar(k) / n ? low : high) = s;
        }
        depths[k] = 0.5f * (low + high);
    }
    return depths;
}

// Shares of what a full neighbourhood holds on the average. A layer of the cubic lattice at a surface has half of it; the next
// one, 1.5 spacings below, 0.8 and more. In close-packed layers it is up to 0.82 at the surface, and 1.25 inside.
constexpr scalar fewestInside = 0.7f, mostExposed = 0.85f;

std::uint32_t neighbours(const Liquid& liquid, scalar share)
{
    const scalar supports = liquid.support() / liquid.spacing();
    return std::uint32_t(share * 4.18879f * supports * supports * supports);
}

}

void FreeSurface::requireUsual(const Liquid& liquid)
{
    if (active()) return;
    require(liquid, usualSupport(liquid), 0);
    isUsual_ = true;
}

void FreeSurface::require(const Liquid& liquid, scalar support, scalar suction)
{
    isUsual_ = false;
    const scalar h = support * liquid.spacing();
    suction_ = suction;
    kernel_.emplace(h);
    const WendlandC2 W = *kernel_;
    latticeSum_ = latticeSum(liquid.spacing(), h, [&](scalar r) { return W.W(r); });

    const auto plane = tabulateHalfSpace(W);
    plane_.upload(plane);
    const HalfSpaceView view{{plane.data(), int(plane.size())}, h};
    steepest_ = view(0).gradient;

    const scalar shallowest = 0.5f * liquid.spacing();
    largestRatio_ = ratioAt(view, shallowest);
    depthOfRatio_.upload(tabulateDepths(view, shallowest));
    if (!foundContact_) contact_.upload(std::vector<ContactLine>(1));
}

bool FreeSurface::cutOff()
{
    if (asked_) found_ = int(*readCount_.wait());
    if (askedContact_) foundContact_ = *readContact_.wait() > 0;
    asked_ = askedContact_ = false;
    return found_ > room_ || (foundContact_ && contact_.size() < room_);
}

void FreeSurface::makeRoom()
{
    if (found_ > room_)
    {
        room_ = found_ + found_ / 8;
        gradient_.discard();
        depth_.discard();
        position_.discard();
        if (foundContact_) contact_.discard();
        device::dropKeptMemory();           // of as many as there were: nobody asks for it again
        gradient_.resize(room_);
        depth_.resize(room_);
    }
    if (foundContact_) contact_.resize(room_);
}

void FreeSurface::search(const Liquid& liquid, const Neighbourhood& near, const Walls& walls)
{
    if (!active()) return;
    makeRoom();
    if (!extended_) extended_.emplace(*kernel_, walls.contactAngles(kernel_->h));
    edges_.follow(walls.view(liquid).planes, *kernel_, liquid);
    constexpr scalar oneSided = 0.225f;         // of the support; 0.375 for all of a half-space
    Buffer<std::uint8_t> isExposed(liquid.all()), isNear(liquid.all());
    NeighbourLoop(liquid, {}, {placesOf(liquid.predicted)}).forEachTeam(FindExposed
    {
        liquid.predicted.span(), near.view(), neighbours(liquid, fewestInside), neighbours(liquid, mostExposed), liquid.support(),
        oneSided * liquid.support(), isExposed.span()
    });
    const FindSurface findSurface{near.view(), std::as_const(isExposed).span(), isNear.span()};
    NeighbourLoop(liquid, {valuesOf(isExposed)}).forEachTeam(findSurface, {valuesOf(isNear)}, GhostsOf::all);
    isExposed = {};
    particles_.ghosts = liquid.all() - liquid.owned();
    select(isNear, particles_, room_, readCount_);
    asked_ = true;
    const bool begins = room_ == 0;
    if (begins && cutOff())
    {
        makeRoom();
        select(isNear, particles_, room_, readCount_);
    }
    reconstruct(liquid, near, walls);
    if (begins && cutOff())
    {
        makeRoom();
        reconstruct(liquid, near, walls);
    }
}

void FreeSurface::reconstruct(const Liquid& liquid, const Neighbourhood& near, const Walls& walls)
{
    position_.resizeDiscarding(room_);
    NeighbourLoop(liquid, {}, {placesOf(liquid.predicted)}).run([&]
    {
        asShared(near.wide(liquid), [&]<class Search>(const Search& wide)
        {
            forEachGroup(particles_, SumColour<Search>{*kernel_, liquid.particleVolume() / latticeSum_, wide, particles_.indices.span(), gradient_.span()});
        });
    });
    if (anyContact_.size() == 0)
    {
        anyContact_.resize(1);
        anyContact_.setZero();
    }
    forEachTeam(particles_, Reconstruct
    {
        liquid.predicted.span(), {{extended_->view(), kernel_->h, walls.view(liquid), edges_.view()}, plane(), steepest_, held_ ? held_->span() : Span<const scalar>{}},
        depthOfRatio_.span(), largestRatio_, suction_, particles_.before.span(), gradient_.span(), depth_.span(), position_.span(),
        foundContact_ ? contact_.span() : Span<ContactLine>{}, anyContact_.span()
    });
    if (foundContact_) return;
    readContact_.ask(anyContact_);
    askedContact_ = true;
}

}
