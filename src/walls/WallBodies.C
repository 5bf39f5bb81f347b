// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/WallBodies.H"

#include "device/Reduce.H"
#include "wallMotions/SixDoFBody.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

Vec3 toVec(const Vector3& v) { return {scalar(v.x), scalar(v.y), scalar(v.z)}; }

BodyPose scaledPose(const Pose& pose, double unit)
{
    BodyPose scaled;
    for (int k = 0; k < 3; ++k)
    {
        for (int l = 0; l < 3; ++l) scaled.row[k][l] = pose.rows[k][l];
        scaled.shift[k] = pose.shift[k] / unit;
    }
    return scaled;
}

// Of the change from the pose before to the one now: the point that is at x now was at y before, with x = R y + s. So it went by x - y = s' + (I - R^T)(x - c) with s' = c - R^T (c - s).
BodyVelocity velocityOf(const Pose& change, double dt, const Vector3& centre, const Units& units)
{
    BodyVelocity velocity{};
    if (!(dt > 0)) return velocity;
    const double perTime = units.time / dt;
    velocity.centre = placeAt(centre.x / units.length, centre.y / units.length, centre.z / units.length);
    velocity.atCentre = toVec((perTime / units.length) * (centre - change.turnedBack(centre - change.shift)));
    for (int k = 0; k < 3; ++k)
    {
        Vector3 row{-change.rows[0][k], -change.rows[1][k], -change.rows[2][k]};
        row[k] += 1;
        velocity.row[k] = toVec(perTime * row);
    }
    return velocity;
}

struct LongestArm
{
    scalar distance2 = 0;

    HOST_DEVICE void add(const LongestArm& other) { distance2 = fmax(distance2, other.distance2); }
};

// Of a particle from an axis.
struct FromAxis
{
    Place origin;
    Vec3 direction;
    Span<const Position> position;

    HOST_DEVICE LongestArm operator()(int i) const
    {
        const Place at = placeOf(position[i]);
        const Vec3 r{scalar(quanta::lengthOf(at.x - origin.x)), scalar(quanta::lengthOf(at.y - origin.y)), scalar(quanta::lengthOf(at.z - origin.z))};
        return {squared(r - dot(r, direction) * direction)};
    }
};

// The largest part of `of` a pose's change per second, of pieces of the time.
template<class F>
double fastest(const WallMotion& motion, double from, double to, const F& of)
{
    constexpr int pieces = 16;
    double most = 0;
    for (int k = 0; k < pieces && to > from; ++k)
    {
        const double a = from + (to - from) * k / pieces, b = from + (to - from) * (k + 1) / pieces;
        most = std::max(most, of(motion.at(b).since(motion.at(a))) / (b - a));
    }
    return most;
}

// Of a rotation, radians.
double angleOf(const Pose& change)
{
    const Vector3 twiceSine{change.rows[2].y - change.rows[1].z, change.rows[0].z - change.rows[2].x, change.rows[1].x - change.rows[0].y};
    return std::atan2(length(twiceSine), change.rows[0].x + change.rows[1].y + change.rows[2].z - 1);
}

}

bool WallBodies::turn() const
{
    return std::any_of(motions_.walls().begin(), motions_.walls().end(), [](const MovingWall& wall) { return wall.motion->axis().has_value(); });
}

void WallBodies::moveTo(double from, double to)
{
    if (none()) return;
    poses_.clear();
    std::vector<BodyVelocity> velocities;
    for (const MovingWall& wall : motions_.walls())
    {
        const Pose now = wall.motion->at(to);
        const auto axis = wall.motion->axis();
        poses_.push_back(scaledPose(now, units_.length));
        velocities.push_back(velocityOf(now.since(wall.motion->at(from)), to - from, axis ? axis->origin : Vector3(), units_));
    }
    dt_ = units_.toScaled(to - from, dimensions::time);
    poseBuffer_.upload(poses_);
    velocityBuffer_.upload(velocities);
}

double WallBodies::speed(const Liquid& liquid, double from, double to) const
{
    double most = 0;
    for (const MovingWall& wall : motions_.walls())
    {
        if (const SixDoFBody* body = wall.motion->body())
        {
            most = std::max(most, body->speed());
            continue;
        }
        const auto axis = wall.motion->axis();
        if (!axis)
        {
            most = std::max(most, fastest(*wall.motion, from, to, [](const Pose& change) { return length(change.shift); }));
            continue;
        }
        const Vector3 origin = axis->origin / units_.length;
        Buffer<LongestArm> scratch;
        const LongestArm own = liquid.owned() == 0 ? LongestArm() : reduce(liquid.owned(), FromAxis{placeAt(origin.x, origin.y, origin.z), toVec(axis->direction), liquid.position.span()}, scratch);
        const double arm = units_.length * std::sqrt(double(liquid.parts().fold(own).distance2));
        most = std::max(most, arm * fastest(*wall.motion, from, to, angleOf));
    }
    return most;
}

}
