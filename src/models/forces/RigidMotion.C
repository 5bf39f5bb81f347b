// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/forces/RigidMotion.H"

#include <utility>

namespace shizuku
{

HOST_DEVICE void RigidMotion::Sums::add(const Sums& other)
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
    particles += other.particles;
    atWall += other.atWall;
}

namespace
{

constexpr int armBits = 19, wayBits = 31;               // of quanta

HOST_DEVICE inline std::int64_t arm(std::int64_t place) { return place >> (quanta::fractionBits - armBits); }
HOST_DEVICE inline Int128 product(std::int64_t a, std::int64_t b) { return Int128(a) * b; }

struct SumsOfParticle
{
    Span<const Position> position;
    Span<const Vec3> pressure, forces;                  // either of the displacements may be empty
    scalar ofPressure, ofForces;                        // their scales
    Span<const Vec3> velocity;                          // empty where there are walls
    scalar dt;
    WallView walls;
    scalar reach;

    HOST_DEVICE RigidMotion::Sums operator()(int i) const
    {
        const Position p = position[i];
        const Place at = placeOf(p);
        const Vec3 q = pressure.size > 0 ? ofPressure * pressure[i] : Vec3{}, r = forces.size > 0 ? ofForces * forces[i] : Vec3{};
        const std::int64_t x = arm(at.x), y = arm(at.y), z = arm(at.z);
        const bool isFree = velocity.size > 0;
        const Vec3 part = isFree ? q + r : r, all = isFree ? dt * velocity[i] : q + r;
        const std::int64_t f = wholeQuanta(part.x, wayBits), g = wholeQuanta(part.y, wayBits), h = wholeQuanta(part.z, wayBits);
        const std::int64_t u = wholeQuanta(all.x, wayBits), v = wholeQuanta(all.y, wayBits), w = wholeQuanta(all.z, wayBits);
        return
        {
            {u, v, w}, {f, g, h}, {Int128(x), Int128(y), Int128(z)},
            {product(y, w) - product(z, v), product(z, u) - product(x, w), product(x, v) - product(y, u)},
            {product(x, x), product(y, y), product(z, z)}, {product(x, y), product(y, z), product(z, x)}, 1, walls.isNear(i, p, reach, {}) ? 1 : 0
        };
    }
};

// What is to be removed.
struct FindMotion
{
    Span<const RigidMotion::Sums> sums, before;          // of all parts; before: empty where there are walls
    WallConstraints walls, adhesive;                     // adhesive: those that bear other forces than pressure
    bool always;                                         // they hold whether a wall is near or not: at sides
    Span<RigidMotion::Motion> motion;

    HOST_DEVICE void operator()(int) const
    {
        const RigidMotion::Sums all = allOf(sums);
        const double n = double(all.particles);
        const bool atWall = always || all.atWall > 0;
        const WallConstraints any = atWall ? walls : WallConstraints{}, bearing = atWall ? adhesive : WallConstraints{};
        const Vec3 forces = mean(all.forces, n), borne = forces - any.freePart(forces);
        const AboutCentroid about(all);
        const Place origin{about.origin(0), about.origin(1), about.origin(2)};
        const Vec3 momentum = about.momentum(n) - (before.size > 0 ? AboutCentroid(allOf(before)).momentum(n) : Vec3{});
        const Vec3 by = before.size > 0 ? forces : any.freePart(mean(all.d, n)) + bearing.freePart(borne);
        motion[0] = {by, any.mayTurn() ? turn(momentum, about, n, any) : Vec3{}, about.rest(n), origin};
    }

private:
    HOST_DEVICE static RigidMotion::Sums allOf(Span<const RigidMotion::Sums> parts)
    {
        RigidMotion::Sums all = parts[0];
        for (int k = 1; k < parts.size; ++k) all.add(parts[k]);
        return all;
    }

    // The sums about a place next to the centroid: exact, as they are, so that what is small is not lost in what is large.
    struct AboutCentroid
    {
        std::int64_t c[3];
        double d[3], x[3], turn[3], xx[3], xy[3];       // scaled

        HOST_DEVICE explicit AboutCentroid(const RigidMotion::Sums& all)
        {
            const Int128 n = all.particles;
            Int128 rest[3];
            for (int k = 0; k < 3; ++k)
            {
                c[k] = std::int64_t(rint(double(Int128(all.x[k])) / double(all.particles)));
                rest[k] = Int128(all.x[k]) - n * c[k];
            }
            for (int k = 0; k < 3; ++k)
            {
                const int l = (k + 1) % 3, m = (k + 2) % 3;
                d[k] = way * double(all.d[k]);
                x[k] = length * double(rest[k]);
                turn[k] = length * way * double(Int128(all.turn[k]) - (Int128(c[l]) * all.d[m] - Int128(c[m]) * all.d[l]));
                xx[k] = length * length * double(Int128(all.xx[k]) - Int128(2 * c[k]) * Int128(all.x[k]) + n * c[k] * c[k]);
                xy[k] = length * length * double(Int128(all.xy[k]) - Int128(c[k]) * Int128(all.x[l]) - Int128(c[l]) * Int128(all.x[k]) + n * c[k] * c[l]);
            }
        }

        HOST_DEVICE std::int64_t origin(int k) const { return c[k] << (quanta::fractionBits - armBits); }
        HOST_DEVICE Vec3 rest(double n) const { return vec(x[0] / n, x[1] / n, x[2] / n); }

        HOST_DEVICE Vec3 momentum(double n) const
        {
            return vec
            (
                turn[0] - (x[1] * d[2] - x[2] * d[1]) / n, turn[1] - (x[2] * d[0] - x[0] * d[2]) / n, turn[2] - (x[0] * d[1] - x[1] * d[0]) / n
            );
        }
    };

    static constexpr double length = 1.0 / (std::int64_t(1) << armBits), way = 1.0 / double(std::int64_t(1) << wayBits);

    HOST_DEVICE static Vec3 mean(const std::int64_t* of, double n)
    {
        return vec(way * double(of[0]) / n, way * double(of[1]) / n, way * double(of[2]) / n);
    }

    // The turn about the centroid that has this angular momentum. None where the liquid is as thin as a line.
    HOST_DEVICE static Vec3 turn(Vec3 ofAll, const AboutCentroid& all, double n, const WallConstraints& constraints)
    {
        const double* x = all.x;
        const Vec3 momentum = constraints.freeRotation(ofAll);
        const double xx = all.xx[0] - x[0] * x[0] / n, yy = all.xx[1] - x[1] * x[1] / n, zz = all.xx[2] - x[2] * x[2] / n;
        const double xy = all.xy[0] - x[0] * x[1] / n, yz = all.xy[1] - x[1] * x[2] / n, zx = all.xy[2] - x[2] * x[0] / n;
        const double trace = xx + yy + zz;
        if (!(trace > 0)) return {};
        const Vec3 a = 1 / scalar(trace) * vec(yy + zz, -xy, -zx), b = 1 / scalar(trace) * vec(-xy, xx + zz, -yz),
            c = 1 / scalar(trace) * vec(-zx, -yz, xx + yy);
        const scalar determinant = dot(a, cross(b, c));
        if (!(determinant > 1e-6f)) return {};
        const Vec3 adjugate = vec(dot(momentum, cross(b, c)), dot(momentum, cross(c, a)), dot(momentum, cross(a, b)));
        return constraints.freeRotation(1 / (scalar(trace) * determinant) * adjugate);
    }

    HOST_DEVICE static Vec3 vec(double a, double b, double c) { return {scalar(a), scalar(b), scalar(c)}; }
};

struct RemoveMotion
{
    Span<const RigidMotion::Motion> motion;
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

template<class F>
void RigidMotion::sum(const Liquid& liquid, const F& ofParticle, Buffer<Sums>& sums)
{
    reduce(liquid.owned(), ofParticle, scratch_, sums);
    if (liquid.parts().parts() == 1) return;
    liquid.ghosts().gather(sums, scratch_);
    sums.swap(scratch_);
}

void RigidMotion::begin(const Liquid& liquid, const Walls& walls, scalar dt)
{
    before_ = {};
    if (!walls.constraints().none()) return;
    sum(liquid, SumsOfParticle{liquid.position.span(), {}, {}, 0, 0, liquid.velocity.span(), dt, walls.view(liquid), 0}, before_);
}

void RigidMotion::remove
(
    Liquid& liquid, const InternalDisplacement& pressure, const InternalDisplacement& forces, const Walls& walls,
    scalar reach, scalar dt
)
{
    if (walls.constraints().all() || (pressure.isNone() && forces.isNone())) return;       // alike in all parts, which come to the sum together
    const Span<const Vec3> velocity = before_.size() > 0 ? std::as_const(liquid.velocity).span() : Span<const Vec3>{};
    sum
    (
        liquid,
        SumsOfParticle
        {
            liquid.position.span(), pressure.by, forces.by, pressure.scale, forces.scale, velocity, dt, walls.view(liquid), reach
        },
        sums_
    );
    motion_.resizeDiscarding(1);
    forEach(1, FindMotion{sums_.span(), before_.span(), walls.constraints(), walls.adhesiveConstraints(), !walls.sideConstraints().none(), motion_.span()});
    forEach(liquid.owned(), RemoveMotion{motion_.span(), 1 / dt, liquid.position.span(), liquid.velocity.span()});
}

}
