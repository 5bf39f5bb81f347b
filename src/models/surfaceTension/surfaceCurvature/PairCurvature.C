// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/surfaceTension/surfaceCurvature/PairCurvature.H"

#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

// Single normals are tilted by a few degrees where the particles stand in layers along a wall; their mean is not.
template<class Search>
struct SmoothNormal
{
    WendlandC2 W;
    scalar steepest;                        // the planar |G|
    FreeSurfaceView surface;
    Search near;
    Span<Vec3> normal;                      // with b; zero away from the surface

    HOST_DEVICE void operator()(Group places, Team team) const
    {
        const scalar least = leastSlope * steepest;
        GroupOfParticles group{};
        Vec3 own[Group::most];
        #pragma unroll
        for (int p = 0; p < Group::most; ++p)
        {
            group.index[p] = places[p];
            own[p] = surface.gradient[places[p]];
            if (p < places.size && squared(own[p]) > least * least) group.members |= 1u << p;
        }
        Team::Vector around[Group::most];
        near.forEach(group, [&](auto l) { return surface.gradient[l]; }, [&](int p, auto Gl, auto r)
        {
            const auto same = squared(Gl) > least * least && dot(own[p], Gl) >= 0;
            if (noneOf(same)) return;
            around[p] -= (same ? W.W(norm(r)) : 0) * Gl;
        }, team);
        const Vec3 sums = team.sums(around);
        if (team.lane >= places.size) return;
        const int k = places.first + team.lane;
        const Vec3 G = surface.gradient[k], sum = sums - W.W(0) * G;
        const bool isNear = (group.members >> team.lane & 1) != 0;
        normal[k] = isNear ? withWeight(1 / norm(sum) * sum, surfaceWeight(norm(G) / steepest)) : Vec3{};
    }
};

template<class Search>
struct Curvature : CurvatureSums
{
    Search near;                            // among positions with depths

    HOST_DEVICE void operator()(Group places, Team team) const
    {
        const SurfaceGroup group(places, normal, near);
        Team::Scalar spreads[Group::most] = {}, weights[Group::most] = {}, depths[Group::most] = {};
        near.forEach(group.members, [&](auto l) { return normal[l]; }, [&](int p, auto other, auto r)
        {
            const auto same = onSameSurface(group.normal[p], other);
            if (noneOf(same)) return;
            const auto mean = group.normal[p] + other;
            const auto slope = same ? -volume * weightBeside(other) * W.g(norm(r)) : 0;
            const auto up = dot(r, mean);
            const auto along = same ? slope * (squared(r) - up * up / squared(mean)) : 0;
            spreads[p] -= slope * dot(r, other - group.normal[p]);
            weights[p] += along;
            depths[p] += along * 0.5f * (group.depth[p] + depthBeside(r));
        }, team);
        const scalar spread = team.sums(spreads), weight = team.sums(weights), depth = team.sums(depths);
        if (!group.has(team.lane)) return;
        const int k = places.first + team.lane;
        addWalls(k, spread, weight, depth);
    }

private:
    // The walls' part, and what comes of all.
    HOST_DEVICE void addWalls(int k, scalar spread, scalar weight, scalar depth) const
    {
        const int i = int(selected[k]);
        const Position xi = near.points[k];
        const Vec3 mi = normal[k];
        const scalar own = surface.depthOf(k);
        const ContactLine line = surface.contactAt(k);
        walls.forEachContact(i, xi, W.h, [&](int a, const WallContact& wall)
        {
            if (a != line.wall) return;
            const WedgeIntegrals wedge = extended(line.theta, wall.distance / W.h, line.depth / W.h);
            const Vec3 slope = 1 / W.h * (wedge.tangential * line.tangent + wedge.normal * wall.normal);
            const scalar sine = sin(line.theta), cosine = cos(line.theta);
            const scalar along = fmax(0, -fromContactLine(wall.distance, line, sine) * dot(slope, alongFromLine(wall, line)));
            spread += dot(slope, sine * line.tangent + cosine * wall.normal - mi);
            weight += along;
            depth += along * own;
        });
        const scalar kappa = weight > 0 ? fmin(fmax(2 * spread / weight, -largest), largest) : 0;
        curvature[k] = weight > 0 ? broughtUp(kappa, depth / weight) : 0;
    }
};

}

PairCurvature::PairCurvature(const Dictionary& coeffs, const Liquid& liquid, FreeSurface& surface, scalar sigma)
:
    SurfaceCurvature(coeffs, liquid, surface, sigma, WedgePart::whole)
{}

CurvatureField PairCurvature::normals(const Liquid& liquid, const Neighbourhood& near, const Walls&)
{
    CurvatureField field = makeField();
    NeighbourLoop(liquid, {surface_.positions(), surface_.gradients()}).run([&]
    {
        asShared(near.wide(liquid, surface_.particles(), surface_.position()), [&]<class Search>(const Search& among)
        {
            forEachGroup(surface_.particles(), SmoothNormal<Search>{surface_.kernel(), surface_.steepest(), surface_.view(), among, field.normal.span()});
        });
    }, GhostsOf::all);
    return field;
}

Columns PairCurvature::read(CurvatureField& field) const
{
    return {valuesOf(surface_.particles(), field.normal)};
}

void PairCurvature::curvatures(CurvatureField& field, const Liquid& liquid, const Neighbourhood& near, const Walls& walls)
{
    findCurvatures(field, liquid, near, walls, [&]<class Search>(const CurvatureSums& sums, const Search& among)
    {
        forEachGroup(surface_.particles(), Curvature<Search>{sums, among});
    });
}

}
