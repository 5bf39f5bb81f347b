#include "freeSurface/FreeSurface.H"

#include "device/Algorithms.H"
#include "device/Holds.H"
#include "device/KeptMemory.H"
#include "maths/EvenTable.H"
#include "maths/Lattice.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// Tells the particles near the surface from those deep inside, all around which there is liquid that has liquid all around:
// the surface is farther than the density's support.
struct FindSurface
{
    NeighbourView near;
    std::uint32_t leastInside;              // neighbours: fewer have those at the surface
    Span<std::uint8_t> isNear;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        float open = near.count[i] < leastInside ? 1 : 0;
        near.forEach(i, [&](int j) { if (near.count[j] < leastInside) open = 1; }, team);
        open = team.sum(open);
        if (team.first()) isNear[i] = open > 0;
    }
};

// The liquid's part in the colour and its gradient.
struct SumColour
{
    WendlandC2 W;
    float volume;                           // V/S
    NeighbourSearch wide;
    Span<const std::uint32_t> selected;
    Span<Vec3> gradient;                    // with w = the colour

    HOST_DEVICE void operator()(Group places, Team team) const
    {
        GroupOfParticles group;
        group.members = places.members();
        #pragma unroll
        for (int p = 0; p < Group::most; ++p) group.index[p] = int(selected[places[p]]);
        Team::Float values[Group::most] = {};
        Team::Vector slopes[Group::most];
        wide.forEach(group, [](auto) { return 0; }, [&](int p, int, auto r)
        {
            const auto distance = norm(r);
            values[p] += W.W(distance);
            slopes[p] += W.g(distance) * r;
        }, team);
        const float sum = team.sums(values);
        const Vec3 G = team.sums(slopes);
        if (team.lane >= places.size) return;
        const int k = places.first + team.lane;
        gradient[k] = {volume * G.x, volume * G.y, volume * G.z, volume * (W.W(0) + sum)};
    }
};

// Adds the walls, and reads the depth. The lanes of a team share what is tried at contact lines.
struct Reconstruct
{
    static constexpr Holds holds = Holds::much;

    WendlandC2 W;
    Span<const Vec3> x;
    WallCompletion completion;
    HalfSpaceView plane;
    Span<const float> depthOfRatio;
    float largestRatio, steepest, suction;
    Span<const std::uint32_t> place;
    Span<Vec3> gradient, position;
    Span<ContactLine> contact;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const int k = int(place[i]);
        const Vec3 xi = x[i];
        Vec3 G = gradient[k];
        float colour = G.w;
        const ContactLine line = findContact(i, xi, colour, G, team);
        const auto wall = completion(i, xi, line, team);
        if (!team.first()) return;
        colour += wall.value;
        G += wall.gradient;
        contact[k] = line;
        gradient[k] = {G.x, G.y, G.z, -suction};
        position[k] = {xi.x, xi.y, xi.z, depthOf(norm(G) / colour * W.h)};
    }

private:
    HOST_DEVICE ContactLine findContact(int i, Vec3 xi, float colour, Vec3 G, Team team) const
    {
        ContactLine line;
        Vec3 normal;
        float nearest = W.h, cosine = 0;
        completion.walls.forEachContact(i, xi, W.h, [&](int a, const WallContact& wall)
        {
            if (wall.distance >= nearest) return;
            nearest = wall.distance;
            normal = wall.normal;
            cosine = wall.cosTheta;
            line.wall = a;
        });
        if (!team.anyBeside(line.wall >= 0)) return line;

        line.theta = acosf(fminf(fmaxf(cosine, -1), 1));

        // The other walls count as full, with what of them lies in front of this one.
        float open = 1;
        Vec3 others;
        completion.walls.forEachContact(i, xi, W.h, [&](int a, const WallContact& wall)
        {
            if (a == line.wall) return;
            const WedgeIntegrals full = completion.extended(line.theta, wall.distance / W.h, 1);
            others = (1 - full.value) * others + open * full.normal / W.h * wall.normal;
            open *= 1 - full.value;
        });
        const float inFront = 1 - completion.extended(line.theta, nearest / W.h, 1).value;
        colour += inFront * (1 - open);
        G += inFront * others;
        const Vec3 along = G - dot(G, normal) * normal;
        const float slope = norm(along);
        line.tangent = -1 / fmaxf(slope, 1e-20f) * along;
        line.depth = depthBelow(colour, slope, nearest / W.h, line.theta, team);
        const WallSurfacesView& surfaces = completion.walls.surfaces;
        const bool any = line.wall >= 0;
        const bool bent = any && line.wall < surfaces.count && surfaces.surface[line.wall].type != WallSurface::plane;
        if (team.anyBeside(bent))
        {
            if (bent) line.theta = angleFromAfar(surfaces.surface[line.wall], xi, nearest, normal, line);
            const float depth = depthBelow(colour, slope, nearest / W.h, line.theta, team);
            if (bent) line.depth = depth;
        }
        return any ? line : ContactLine{};
    }

    // The angle at which the interface, at its contact angle to the wall where it meets it, meets the tangent plane of the
    // wall below x: a curved wall turns in between.
    HOST_DEVICE float angleFromAfar
    (
        const WallSurface& wall, Vec3 x, float distance, Vec3 normal, const ContactLine& line
    ) const
    {
        const float sine = sinf(line.theta), cosine = cosf(line.theta);
        const float along = (line.depth + distance * cosine) / fmaxf(sine, 0.1f);
        const Vec3 there = wall(x + fminf(fmaxf(along, -W.h), W.h) * line.tangent - distance * normal).normal;
        const Vec3 tangent = line.tangent - dot(line.tangent, there) * there;
        const Vec3 interface = sine / fmaxf(norm(tangent), 1e-20f) * tangent + cosine * there;
        return acosf(fminf(fmaxf(dot(interface, normal), -1), 1));
    }

    // The depth at which a planar interface that meets the wall at theta would leave that much colour, and that slope of it
    // along the wall, to the liquid in front of the wall: least squares of both, each over its largest value.
    HOST_DEVICE float depthBelow(float colour, float slope, float z, float theta, Team team) const
    {
        const float sine = sinf(theta);
        const auto misfit = [&](float s)
        {
            const HalfSpaceValues gas = plane(s);
            const WedgeIntegrals wedge = completion.extended(theta, z, s / W.h);
            const float c = colour - (1 - gas.density - wedge.value);
            const float g = (sine * gas.gradient + wedge.tangential / W.h - slope) / steepest;
            return c * c + g * g;
        };
        constexpr int trials = 12;
        Team::Least best{1e30f, 0};
        for (int k = team.lane; k <= trials; k += team.width)
        {
            const float s = (2 * float(k) / trials - 1) * W.h, here = misfit(s);
            if (here < best.value) best = {here, s};
        }
        best = team.least(best);
        constexpr float finest = 0.01f;
        float step = W.h / trials;
        for (; step > finest * W.h; step *= 0.5f)
        {
            Team::Least next = best;
            for (int side = team.lane; side < 2; side += team.width)
            {
                const float s = best.at + (side == 0 ? -step : step), here = s <= W.h ? misfit(s) : best.value;
                if (here < next.value) next = {here, s};
            }
            best = team.least(next);
        }
        // The lowest point of a parabola: a depth that moves in steps makes the contact line tremble.
        float before = 0, after = 0;
        for (int side = team.lane; side < 2; side += team.width)
        {
            (side == 0 ? before : after) = misfit(best.at + (side == 0 ? -step : step));
        }
        before = team.sum(before);
        after = team.sum(after);
        const float bend = before + after - 2 * best.value;
        const float lowest = bend > 0 ? 0.5f * (before - after) / bend : 0;
        return best.at + fminf(fmaxf(lowest, -1), 1) * step;
    }

    // What has no number is not deep.
    HOST_DEVICE float depthOf(float ratio) const
    {
        return valueAt(depthOfRatio, ratio < largestRatio ? ratio / largestRatio : 1);
    }
};

// 0.7 of what a full neighbourhood holds on the average. A layer of the cubic lattice at a surface has half of it; the next
// one, 1.5 spacings below, 0.8 and more.
std::uint32_t leastInside(const Liquid& liquid)
{
    const float supports = liquid.support() / liquid.spacing();
    return std::uint32_t(0.7f * 4.18879f * supports * supports * supports);
}

}

void FreeSurface::require(const Liquid& liquid, Walls& walls, float support, float suction)
{
    const float h = support * liquid.spacing();
    walls.requireContacts(liquid, h);
    suction_ = suction;
    kernel_.emplace(h);
    const WendlandC2 W = *kernel_;
    latticeSum_ = latticeSum(liquid.spacing(), h, [&](float r) { return W.W(r); });

    const auto plane = tabulateHalfSpace(W);
    plane_.upload(plane);
    const HalfSpaceView view{{plane.data(), int(plane.size())}, h};
    steepest_ = view(0).gradient;

    // From deep inside to half a spacing below the surface the ratio grows: invert it there.
    const float shallowest = 0.5f * liquid.spacing();
    const auto ratio = [&](float s) { return h * view(s).gradient / (1 - view(s).density); };
    largestRatio_ = ratio(shallowest);
    constexpr int n = 256;
    std::vector<float> depths(n + 1);
    for (int k = 0; k <= n; ++k)
    {
        float low = shallowest, high = h;
        for (int step = 0; step < 40; ++step)
        {
            const float s = 0.5f * (low + high);
            (ratio(s) > largestRatio_ * float(k) / n ? low : high) = s;
        }
        depths[k] = 0.5f * (low + high);
    }
    depthOfRatio_.upload(depths);
}

void FreeSurface::update(const Liquid& liquid, const Neighbourhood& near, const Walls& walls)
{
    search(liquid, near, walls);
    if (cutOff()) search(liquid, near, walls);
}

bool FreeSurface::cutOff()
{
    if (asked_) found_ = int(*readCount_.wait());
    asked_ = false;
    return found_ > room_;
}

void FreeSurface::makeRoom()
{
    room_ = found_ + found_ / 8;
    gradient_.discard();
    position_.discard();
    contact_.discard();
    device::dropKeptMemory();               // of as many as there were: nobody asks for it again
    gradient_.resize(room_);
    position_.resize(room_);
    contact_.resize(room_);
}

void FreeSurface::search(const Liquid& liquid, const Neighbourhood& near, const Walls& walls)
{
    if (!active()) return;
    if (found_ > room_) makeRoom();
    if (!extended_) extended_.emplace(*kernel_, walls.contactAngles(kernel_->h));
    const int n = liquid.owned();
    Buffer<std::uint8_t> isNear(n);
    forEachTeam(n, FindSurface{near.view(), leastInside(liquid), isNear.span()});
    select(isNear, particles_, room_, readCount_);
    asked_ = true;
    if (room_ == 0 && cutOff())
    {
        makeRoom();
        select(isNear, particles_, room_, readCount_);
    }
    const Span<const std::uint32_t> place = particles_.before.span();
    forEachGroup(particles_, SumColour
    {
        *kernel_, liquid.particleVolume() / latticeSum_, near.wide(liquid), particles_.indices.span(), gradient_.span()
    });
    forEachTeam(particles_, Reconstruct
    {
        *kernel_, liquid.predicted.span(), {extended_->view(), kernel_->h, walls.view()}, {plane_.span(), kernel_->h},
        depthOfRatio_.span(), largestRatio_, steepest_, suction_, place, gradient_.span(), position_.span(), contact_.span()
    });
}

}
