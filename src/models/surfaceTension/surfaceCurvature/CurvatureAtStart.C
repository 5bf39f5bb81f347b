// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/surfaceTension/surfaceCurvature/CurvatureAtStart.H"

#include "particles/NeighbourLoop.H"

#include <utility>

namespace shizuku
{

namespace
{

constexpr scalar unknown = 1e15f;

struct FindChange
{
    FreeSurfaceView surface;
    Span<const Vec3> normal;
    Span<const scalar> curvature;       // of those near the surface
    Span<const scalar> before;          // of all
    Span<scalar> now;
    Span<scalar> change;                // of those near the surface; unknown where one of the two is not there

    HOST_DEVICE void operator()(int i) const
    {
        if (surface.isInside(i))
        {
            now[i] = 0;
            return;
        }
        const int k = int(surface.place[i]);
        const scalar own = squared(normal[k]) > 0 ? curvature[k] : 0, old = before[i];
        change[k] = own != 0 && old != 0 ? own - old : unknown;
        now[i] = own;
    }
};

struct TakeBack
{
    WendlandC2 W;
    NeighbourView near;
    FreeSurfaceView surface;
    Span<const Vec3> normal;
    Span<const scalar> change;
    scalar share;
    Span<scalar> curvature;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const int k = int(surface.place[i]);
        const Vec3 mi = normal[k];
        if (squared(mi) == 0) return;
        const Position xi = surface.position[k];
        scalar weights = 0, changes = 0;
        const auto add = [&](int l, scalar weight)
        {
            if (change[l] == unknown) return;
            weights += weight;
            changes += weight * change[l];
        };
        if (team.first()) add(k, W.W(0));
        forEachOnSurface(i, mi, near, surface, normal, [&](int l, Vec3) { add(l, W.W(norm(surface.position[l] - xi))); }, team);
        weights = team.sum(weights);
        changes = team.sum(changes);
        if (team.first() && weights > 0) curvature[k] -= share * changes / weights;
    }
};

}

CurvatureAtStart::CurvatureAtStart(Liquid& liquid)
:
    before_(liquid.fields().require<scalar>
    ({
        .name = "kappa", .dimensions = Dimensions{{0, -1, 0, 0, 0, 0, 0}}, .written = true, .restarted = true
    }))
{}

void CurvatureAtStart::bring(CurvatureField& field, const Liquid& liquid, const Neighbourhood& near, const FreeSurface& surface, scalar share)
{
    Buffer<scalar> change(surface.particles().indices.size());
    now_.resizeDiscarding(liquid.all());
    const FreeSurfaceView view = surface.view();
    forEach(liquid.owned(), FindChange
    {
        view, field.normal.span(), field.curvature.span(), std::as_const(before_).span(), now_.span(), change.span()
    });
    NeighbourLoop(liquid, {valuesOf(surface.particles(), change)}, {valuesOf(surface.particles(), field.normal)}).forEachTeam(surface.particles(), TakeBack
    {
        surface.kernel(), near.view(), view, field.normal.span(), change.span(), share, field.curvature.span()
    });
}

void CurvatureAtStart::commit()
{
    if (now_.size() == before_.size()) before_.swap(now_);
}

}
