// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/forces/NetMotion.H"

namespace shizuku
{

HOST_DEVICE void NetMotion::Sums::add(const Sums& other)
{
    for (int c = 0; c < 3; ++c)
    {
        d[c] += other.d[c];
        forces[c] += other.forces[c];
        x[c] += other.x[c];
        turn[c] += other.turn[c];
        xx[c] += other.xx[c];
        xy[c] += other.xy[c];
    }
    atWall += other.atWall;
}

namespace
{

struct SumsOfParticle
{
    Span<const Position> position;
    Span<const Vec3> pressure, forces;                  // either of the displacements may be empty
    scalar ofPressure, ofForces;                        // their scales
    WallView walls;
    scalar reach;

    HOST_DEVICE NetMotion::Sums operator()(int i) const
    {
        const Position p = position[i];
        const Place at = placeOf(p), origin = placeOf(position[0]);
        const Vec3 q = pressure.size > 0 ? ofPressure * pressure[i] : Vec3{}, r = forces.size > 0 ? ofForces * forces[i] : Vec3{};
        const double x = quanta::lengthOf(at.x - origin.x), y = quanta::lengthOf(at.y - origin.y), z = quanta::lengthOf(at.z - origin.z);
        const double u = double(q.x) + r.x, v = double(q.y) + r.y, w = double(q.z) + r.z;
        return
        {
            {u, v, w}, {r.x, r.y, r.z}, {x, y, z}, {y * w - z * v, z * u - x * w, x * v - y * u}, {x * x, y * y, z * z},
            {x * y, y * z, z * x}, walls.isNear(i, p, reach, {}) ? 1.0 : 0.0
        };
    }
};

// What is to be taken back: of the sums of n particles.
struct FindMotion
{
    Span<const NetMotion::Sums> sums;
    double n;
    Span<const Position> position;
    HeldDirections walls, pulling;                      // pulling: those that bear other forces than pressure
    Span<NetMotion::Motion> motion;

    HOST_DEVICE void operator()(int) const
    {
        const NetMotion::Sums& all = sums[0];
        const bool atWall = all.atWall > 0;
        const HeldDirections held = atWall ? walls : HeldDirections{}, pulled = atWall ? pulling : HeldDirections{};
        const Vec3 forces = mean(all.forces), borne = forces - held.freePart(forces);
        motion[0] = {held.freePart(mean(all.d)) + pulled.freePart(borne), turn(all, held), mean(all.x), placeOf(position[0])};
    }

private:
    HOST_DEVICE Vec3 mean(const double* of) const { return {scalar(of[0] / n), scalar(of[1] / n), scalar(of[2] / n)}; }

    // The turn whose angular momentum is that of the sums, about their centroid. None where the liquid is as thin as a line.
    HOST_DEVICE Vec3 turn(const NetMotion::Sums& all, const HeldDirections& held) const
    {
        const double *x = all.x, *d = all.d;
        const Vec3 momentum = held.freeTurn(vec
        (
            all.turn[0] - (x[1] * d[2] - x[2] * d[1]) / n,
            all.turn[1] - (x[2] * d[0] - x[0] * d[2]) / n,
            all.turn[2] - (x[0] * d[1] - x[1] * d[0]) / n
        ));
        const double xx = all.xx[0] - x[0] * x[0] / n, yy = all.xx[1] - x[1] * x[1] / n, zz = all.xx[2] - x[2] * x[2] / n;
        const double xy = all.xy[0] - x[0] * x[1] / n, yz = all.xy[1] - x[1] * x[2] / n, zx = all.xy[2] - x[2] * x[0] / n;
        const double trace = xx + yy + zz;
        if (!(trace > 0)) return {};
        const Vec3 a = 1 / scalar(trace) * vec(yy + zz, -xy, -zx), b = 1 / scalar(trace) * vec(-xy, xx + zz, -yz),
            c = 1 / scalar(trace) * vec(-zx, -yz, xx + yy);
        const scalar determinant = dot(a, cross(b, c));
        if (!(determinant > 1e-6f)) return {};
        const Vec3 adjugate = vec(dot(momentum, cross(b, c)), dot(momentum, cross(c, a)), dot(momentum, cross(a, b)));
        return held.freeTurn(1 / (scalar(trace) * determinant) * adjugate);
    }

    HOST_DEVICE static Vec3 vec(double a, double b, double c) { return {scalar(a), scalar(b), scalar(c)}; }
};

struct MoveBack
{
    Span<const NetMotion::Motion> motion;
    scalar perStep;
    Span<Position> position;
    Span<Vec3> velocity;

    HOST_DEVICE void operator()(int i) const
    {
        const auto [mean, turn, centroid, origin] = motion[0];
        const Position from = position[i];
        const Place at = placeOf(from);
        const Vec3 arm = vec(at.x - origin.x, at.y - origin.y, at.z - origin.z) - centroid;
        const Vec3 by = mean + cross(turn, arm);
        position[i] = withBlock(from, from - by);
        velocity[i] -= perStep * by;
    }

private:
    HOST_DEVICE static Vec3 vec(std::int64_t x, std::int64_t y, std::int64_t z)
    {
        return {scalar(quanta::lengthOf(x)), scalar(quanta::lengthOf(y)), scalar(quanta::lengthOf(z))};
    }
};

}

void NetMotion::takeBack
(
    Liquid& liquid, const InternalDisplacement& pressure, const InternalDisplacement& forces, const Walls& walls,
    scalar reach, scalar dt
)
{
    const int n = liquid.owned();
    if (n == 0 || walls.held().all() || pressure.by.size() + forces.by.size() == 0) return;
    reduce
    (
        n,
        SumsOfParticle
        {
            liquid.position.span(), pressure.by.span(), forces.by.span(), pressure.scale, forces.scale, walls.view(liquid), reach
        },
        scratch_, sums_
    );
    motion_.resizeDiscarding(1);
    forEach(1, FindMotion{sums_.span(), double(n), liquid.position.span(), walls.held(), walls.pulling(), motion_.span()});
    forEach(n, MoveBack{motion_.span(), 1 / dt, liquid.position.span(), liquid.velocity.span()});
}

}
