#include "freeSurface/FreeSurface.H"

#include "maths/Lattice.H"

#include <algorithm>

namespace shizuku
{

namespace
{

struct Reconstruct
{
    WendlandC2 W;
    float volume;                           // V/S
    Span<const Vec3> x;
    NeighbourSearch wide;
    NeighbourView near;
    std::uint32_t leastInside;              // neighbours in `near`: fewer have those at the surface
    WallCompletion completion;
    HalfSpaceView plane;
    Span<const float> depthOfRatio;
    float largestRatio, suction;
    Span<Vec3> gradient;
    Span<float> depth;
    Span<ContactLine> contact;
    Span<float> lowestPressure;

    HOST_DEVICE void operator()(int i) const
    {
        lowestPressure[i] = -suction;
        if (isDeep(i))
        {
            contact[i] = {};
            gradient[i] = {};
            depth[i] = W.h;
            return;
        }
        const Vec3 xi = x[i];
        float colour = W.W(0);
        Vec3 G;
        wide.forEach(i, [&](int j)
        {
            const Vec3 r = xi - x[j];
            const float distance = norm(r);
            colour += W.W(distance);
            G += W.g(distance) * r;
        });
        colour *= volume;
        G = volume * G;

        const ContactLine line = findContact(i, xi, colour, G);
        const auto wall = completion(i, xi, line);
        colour += wall.value;
        G += wall.gradient;
        contact[i] = line;
        gradient[i] = G;
        depth[i] = depthOf(norm(G) / colour * W.h);
    }

private:
    // All around there is liquid that has liquid all around: the surface is farther than the density's support.
    HOST_DEVICE bool isDeep(int i) const
    {
        if (near.count[i] < leastInside) return false;
        bool deep = true;
        near.forEach(i, [&](int j) { deep = deep && near.count[j] >= leastInside; });
        return deep;
    }

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
        const Vec3 along = G - dot(G, normal) * normal;
        line.tangent = -1 / fmaxf(norm(along), 1e-20f) * along;

        // The other walls count as full.
        float open = 1;
        completion.walls.forEachContact(i, xi, W.h, [&](int a, const WallContact& wall)
        {
            if (a != line.wall) open *= 1 - completion.extended(line.theta, wall.distance / W.h, 1).value;
        });
        line.depth = depthBelow(colour + 1 - open, nearest / W.h, line.theta);
        const WallSurfacesView& surfaces = completion.walls.surfaces;
        if (line.wall < surfaces.count && surfaces.surface[line.wall].type != WallSurface::plane)
        {
            line.theta = angleFromAfar(surfaces.surface[line.wall], xi, nearest, normal, line);
            line.depth = depthBelow(colour + 1 - open, nearest / W.h, line.theta);
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

    // The depth at which the wall's side of a planar interface would have that much colour in front of it.
    HOST_DEVICE float depthBelow(float colour, float z, float theta) const
    {
        float low = -W.h, high = W.h;
        for (int k = 0; k < 12; ++k)
        {
            const float s = 0.5f * (low + high);
            const float inFront = 1 - plane(s).density - completion.extended(theta, z, s / W.h).value;
            (inFront < colour ? low : high) = s;
        }
        return 0.5f * (low + high);
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
    if (!extended_)
    {
        const auto [smallest, largest] = walls.contactAngles(kernel_->h);
        extended_.emplace(*kernel_, smallest, largest, ExtendedLiquid::Value::kernel);
    }
    gradient_.resizeDiscarding(liquid.all());
    depth_.resizeDiscarding(liquid.all());
    contact_.resizeDiscarding(liquid.all());
    lowestPressure_.resizeDiscarding(liquid.all());
    forEach(liquid.owned(), Reconstruct
    {
        *kernel_, liquid.particleVolume() / latticeSum_, liquid.predicted.span(), near.wide(liquid), near.view(),
        leastInside(liquid),
        {extended_->view(), kernel_->h, walls.view()}, {plane_.span(), kernel_->h}, depthOfRatio_.span(), largestRatio_,
        suction_, gradient_.span(), depth_.span(), contact_.span(), lowestPressure_.span()
    });
}

}
