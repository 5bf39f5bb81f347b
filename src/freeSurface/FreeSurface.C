#include "freeSurface/FreeSurface.H"

#include "device/Algorithms.H"
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
    Span<const std::uint32_t> place;
    Span<float> colour;
    Span<Vec3> gradient;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        Team::Float values{};
        Team::Vector slopes;
        wide.forEach(i, [&](auto, auto r)
        {
            const auto distance = norm(r);
            values += W.W(distance);
            slopes += W.g(distance) * r;
        }, team);
        const float sum = team.sum(values);
        const Vec3 G = team.sum(slopes);
        if (!team.first()) return;
        const int k = int(place[i]);
        colour[k] = volume * (W.W(0) + sum);
        gradient[k] = volume * G;
    }
};

// Adds the walls, and reads the depth.
struct Reconstruct
{
    WendlandC2 W;
    Span<const Vec3> x;
    WallCompletion completion;
    HalfSpaceView plane;
    Span<const float> depthOfRatio;
    float largestRatio, steepest, suction;
    Span<const std::uint32_t> place;
    Span<Vec3> gradient;
    Span<float> depth;                      // holds the colour before
    Span<ContactLine> contact;
    Span<float> lowestPressure;

    HOST_DEVICE void operator()(int i) const
    {
        const int k = int(place[i]);
        const Vec3 xi = x[i];
        float colour = depth[k];
        Vec3 G = gradient[k];
        const ContactLine line = findContact(i, xi, colour, G);
        const auto wall = completion(i, xi, line);
        colour += wall.value;
        G += wall.gradient;
        contact[k] = line;
        gradient[k] = G;
        depth[k] = depthOf(norm(G) / colour * W.h);
        lowestPressure[k] = -suction;
    }

private:
    HOST_DEVICE ContactLine findContact(int i, Vec3 xi, float colour, Vec3 G) const
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
        if (line.wall < 0) return line;

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
        line.depth = depthBelow(colour, slope, nearest / W.h, line.theta);
        const WallSurfacesView& surfaces = completion.walls.surfaces;
        if (line.wall < surfaces.count && surfaces.surface[line.wall].type != WallSurface::plane)
        {
            line.theta = angleFromAfar(surfaces.surface[line.wall], xi, nearest, normal, line);
            line.depth = depthBelow(colour, slope, nearest / W.h, line.theta);
        }
        return line;
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
    HOST_DEVICE float depthBelow(float colour, float slope, float z, float theta) const
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
        float best = -W.h, least = misfit(best);
        for (int k = 1; k <= trials; ++k)
        {
            const float s = (2 * float(k) / trials - 1) * W.h, here = misfit(s);
            if (here >= least) continue;
            least = here;
            best = s;
        }
        constexpr float finest = 0.01f;
        float step = W.h / trials;
        for (; step > finest * W.h; step *= 0.5f)
        {
            for (const float s : {best - step, best + step})
            {
                const float here = s <= W.h ? misfit(s) : least;
                if (here >= least) continue;
                least = here;
                best = s;
            }
        }
        // The lowest point of a parabola: a depth that moves in steps makes the contact line tremble.
        const float before = misfit(best - step), after = misfit(best + step), bend = before + after - 2 * least;
        const float lowest = bend > 0 ? 0.5f * (before - after) / bend : 0;
        return best + fminf(fmaxf(lowest, -1), 1) * step;
    }

    HOST_DEVICE float depthOf(float ratio) const
    {
        const int last = depthOfRatio.size - 1;
        const float place = ratio / largestRatio * float(last);
        if (!(place < float(last))) return depthOfRatio[last];
        const int k = int(place);
        return depthOfRatio[k] + (place - float(k)) * (depthOfRatio[k + 1] - depthOfRatio[k]);
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
    if (!active()) return;
    if (!extended_) extended_.emplace(*kernel_, walls.contactAngles(kernel_->h));
    const int n = liquid.owned();
    Buffer<std::uint8_t> isNear(n);
    forEachTeam(n, FindSurface{near.view(), leastInside(liquid), isNear.span()});
    select(isNear, particles_);

    gradient_.resizeDiscarding(n);
    depth_.resizeDiscarding(n);
    contact_.resizeDiscarding(n);
    lowestPressure_.resizeDiscarding(n);
    const Span<const std::uint32_t> place = particles_.before.span();
    forEachTeam(particles_, SumColour
    {
        *kernel_, liquid.particleVolume() / latticeSum_, near.wide(liquid), place, depth_.span(), gradient_.span()
    });
    forEach(particles_, Reconstruct
    {
        *kernel_, liquid.predicted.span(), {extended_->view(), kernel_->h, walls.view()}, {plane_.span(), kernel_->h},
        depthOfRatio_.span(), largestRatio_, steepest_, suction_, place, gradient_.span(), depth_.span(), contact_.span(),
        lowestPressure_.span()
    });
}

}
