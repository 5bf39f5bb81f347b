// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/TangentPlanes.H"

#include "device/ForEach.H"
#include "walls/ConvexEdges.H"

namespace shizuku
{

namespace
{

// Of each cell of the grid: whether any solid particle may be within reach of a place in it.
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
                for (int i = x - cells * device::cellsInWidth; i <= x + cells * device::cellsInWidth && !any; ++i)
                {
                    const int key = int(grid.key(i, j, k));
                    any = grid.start[key + 1] > grid.start[key];
                }
        around[cell] = any;
    }
};

// The mean velocity of the particles that give a plane, or nothing.
struct MeanVelocity
{
    Span<const Vec3> ofSolid;
    Span<Vec3> ofPlane;

    using Sum = Vec3;
    HOST_DEVICE void add(Sum& sum, scalar weight, int k) const { sum += weight * ofSolid[k]; }
    HOST_DEVICE void store(int i, Sum sum, scalar total) const { ofPlane[i] = total > 0 ? 1 / total * sum : Vec3{}; }
    HOST_DEVICE static Sum over(Team team, Sum sum) { return team.sum(sum); }
};

struct NoVelocity
{
    struct Sum {};
    HOST_DEVICE void add(Sum&, scalar, int) const {}
    HOST_DEVICE void store(int, Sum, scalar) const {}
    HOST_DEVICE static Sum over(Team, Sum) { return {}; }
};

template<class Velocity>
struct FitPlane
{
    scalar spacing, listed, reach;          // listed: up to which distance the lists know
    Span<const Position> x;
    CellGridView grid;                      // of the solid particles
    Span<const std::uint8_t> around;        // FindAround
    WallParticlesView solid;
    Span<Vec3> normal;
    Span<Position> point;
    Velocity velocity;

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const Position xi = x[i];
        const scalar most = reach * reach;
        scalar nearest = most;
        const auto come = [&](int k)
        {
            const scalar distance2 = squared(xi - solid.position[k]);
            if (distance2 < nearest && isSameImage(xi, solid.position[k])) nearest = distance2;
        };
        solid.near.forEach(i, come, team);
        nearest = team.min(nearest);
        if (nearest == most && around[int(grid.key(xi))]) grid.forEachCandidate(AroundPoint{xi, reach}, come, team);
        nearest = team.min(nearest);
        Vec3 direction, from;
        scalar along = 0, cosine = 0, total = 0;
        typename Velocity::Sum velocities{};
        const auto add = [&](int k)
        {
            const Vec3 r = xi - solid.position[k];
            const scalar w = 1 - (squared(r) - nearest) / (4 * spacing * spacing);
            if (w <= 0 || squared(r) >= most || !isSameImage(xi, solid.position[k])) return;
            const scalar inFront = fmin(fmax(dot(solid.normal[k], r) / (0.5f * spacing), 1e-3f), 1);
            const scalar weight = inFront * w * w;
            total += weight;
            direction += weight * solid.normal[k];
            from += weight * r;
            along += weight * dot(solid.normal[k], r);
            cosine += weight * (solid.cosTheta.size > 0 ? solid.cosTheta[k] : 0);
            velocity.add(velocities, weight, k);
        };
        const scalar within = nearest + 4 * spacing * spacing;
        if (within <= listed * listed) solid.near.forEach(i, add, team);
        else if (nearest < most) grid.forEachCandidate(AroundPoint{xi, sqrt(fmin(within, most))}, add, team);
        total = team.sum(total);
        direction = team.sum(direction);
        from = team.sum(from);
        along = team.sum(along);
        cosine = team.sum(cosine);
        velocities = Velocity::over(team, velocities);
        if (!team.first()) return;
        velocity.store(i, velocities, total);
        const scalar length = norm(direction);
        normal[i] = {};
        if (total == 0 || length < 1e-6f * total) return;

        const Vec3 n = (1 / length) * direction;
        const scalar height = (along + dot(n, from)) / (total + length);
        if (nearest - height * height > 2.25f * spacing * spacing) return;
        normal[i] = withCosTheta(n, cosine / total);
        point[i] = xi - (height - 0.5f * spacing) * n;
    }
};

}

TangentPlanes::TangentPlanes(const CellGridView& grid, scalar reach, bool moves) : reach_(reach), moves_(moves), around_(grid.start.size - 1)
{
    forEach(around_.size(), FindAround{grid, reach > grid.cellSize ? 2 : 1, around_.span()});
}

void TangentPlanes::fit(const Liquid& liquid, const CellGridView& grid, const WallParticlesView& solid, const SolidAtPlanes& more, scalar listed)
{
    normal_.resizeDiscarding(liquid.all());
    point_.resizeDiscarding(liquid.all());
    velocity_.resizeDiscarding(moves_ ? liquid.all() : 0);
    const auto fitWith = [&]<class Velocity>(const Velocity& mean)
    {
        forEachTeam(liquid.owned(), FitPlane<Velocity>
        {
            liquid.spacing(), listed, reach_, liquid.predicted.span(), grid, around_.span(), solid,
            normal_.span(), point_.span(), mean
        });
    };
    if (moves_) fitWith(MeanVelocity{more.velocity, velocity_.span()});
    else fitWith(NoVelocity{});
    edge_.resizeDiscarding(more.sharpness.size > 0 ? liquid.all() : 0);
    if (more.sharpness.size > 0) forEach(liquid.owned(), FindPartsOfEdges{listed, liquid.predicted.span(), solid, more.sharpness, edge_.span()});
}

}
