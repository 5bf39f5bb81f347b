// SPDX-License-Identifier: GPL-3.0-or-later
#include "wallMotions/SixDoFBody.H"

#include "core/time/Time.H"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

namespace shizuku
{

namespace
{

const std::vector<std::string> axes{"x", "y", "z"};

// 1 for the axes that are named.
Vector3 freeAxes(const std::vector<std::string>& names, const SourceLocation& where)
{
    Vector3 free;
    for (const std::string& axis : names)
    {
        const auto found = std::find(axes.begin(), axes.end(), axis);
        if (found == axes.end()) throw FatalInputError(where, "Unknown axis '" + axis + "'", "a list of axes, () for none", axes, axis);
        free[int(found - axes.begin())] = 1;
    }
    return free;
}

Vector3 masked(const Vector3& v, const Vector3& free) { return {v.x*free.x, v.y*free.y, v.z*free.z}; }

constexpr Dimensions perTime{{0, 0, -1, 0, 0, 0, 0}}, ofInertia{{1, 2, 0, 0, 0, 0, 0}};

// Its rows at right angles, of length one.
Pose withoutRounding(Pose pose)
{
    auto& [x, y, z] = pose.rows;
    x = normalized(x);
    y = normalized(y - dot(x, y)*x);
    z = cross(x, y);
    return pose;
}

}

SixDoFBody::SixDoFBody(const Dictionary& dict, double start, double stop)
:
    where_(dict.where()), whereMass_(dict.where("mass")), start_(start), stop_(stop), mass_(dict.lookupPositive("mass", dimensions::mass)),
    inertia_(dict.lookupPositive("momentOfInertia", ofInertia)), centreOfMass_(dict.lookupDimensionedVector("centreOfMass", dimensions::length)),
    translations_(freeAxes(dict.lookupOr("translations", axes), dict.where("translations"))), rotations_(freeAxes(dict.lookupOr("rotations", axes), dict.where("rotations")))
{
    if (dict.found("velocity")) velocity_ = dict.lookupDimensionedVector("velocity", dimensions::velocity);
    if (dict.found("omega")) omega_ = dict.lookupDimensionedVector("omega", perTime);
}

void SixDoFBody::belongTo(const std::filesystem::path& casePath, const std::string& wall, double radius)
{
    casePath_ = casePath;
    wall_ = wall;
    radius_ = radius;
}

void SixDoFBody::refuseLight(double density) const
{
    const double own = mass_/volume();
    if (own >= least*density) return;
    std::ostringstream found, expected;
    found << "The body '" << wall_ << "' has a density of " << own << " kg/m3, the liquid one of " << density << ": a body so light answers to the noise of the pressure";
    expected << "a mass of " << least*density*volume() << " kg or more, " << least << " times that of the liquid in its place";
    throw FatalInputError(whereMass_, found.str(), expected.str());
}

void SixDoFBody::refuseOtherStart(const SixDoFBody& before) const
{
    const auto refuse = [&](const std::string& entry)
    {
        throw FatalInputError(where_, "The body '" + wall_ + "' moves, and its " + entry + " was changed, which is that of its start", "the former " + entry + ", or a new run");
    };
    if (velocity_ != before.velocity_) refuse("velocity");
    if (omega_ != before.omega_) refuse("omega");
    if (centreOfMass_ != before.centreOfMass_) refuse("centreOfMass");
}

void SixDoFBody::goOn(const SixDoFState& state)
{
    state_ = state;
    state_->velocity = masked(state.velocity, translations_);
    state_->acceleration = masked(state.acceleration, translations_);
    state_->omega = masked(state.omega, rotations_);
    state_->omegaRate = masked(state.omegaRate, rotations_);
}

Vector3 SixDoFBody::centre() const { return state_ ? state_->pose(centreOfMass_) : centreOfMass_; }

double SixDoFBody::volume() const { return 4*std::numbers::pi/3*radius_*radius_*radius_; }

double SixDoFBody::speed() const { return state_ ? length(state_->velocity) + radius_*length(state_->omega) : 0; }

bool SixDoFBody::turns() const { return squaredLength(rotations_) > 0; }

SixDoFState SixDoFBody::givenAt(double time) const
{
    SixDoFState state;
    state.time = time;
    state.velocity = masked(velocity_, translations_);
    state.omega = masked(omega_, rotations_);
    return state;
}

std::optional<SixDoFState> SixDoFBody::storedAt(double time) const
{
    const auto folder = findInstance(casePath_, time, "uniform/liquid");
    if (folder.empty()) return {};
    const Dictionary numbers = Dictionary::read(folder/"uniform/liquid");
    if (!numbers.found(wall_ + "_time")) return {};
    SixDoFState state;
    SixDoFState::forEach(state, wall_, [&](const std::string& name, double& number) { number = numbers.lookup<double>(name); });
    return state;
}

Pose SixDoFBody::carried(const SixDoFState& state, double time) const
{
    const double passed = std::min(time, stop_) - std::max(state.time, start_);
    if (!(passed > 0)) return state.pose;
    const Vector3 centre = state.pose(centreOfMass_);
    const double rate = length(state.omega);
    Pose turn;
    if (rate > 0) turn = Pose::rotation(centre, state.omega/rate, rate*passed);
    turn.shift += passed*state.velocity;
    return turn.behind(state.pose);
}

Pose SixDoFBody::at(double time) const { return carried(state_ ? *state_ : storedAt(time).value_or(givenAt(0)), time); }

void SixDoFBody::advance(double to, double dt, const BodyLoad& load, const Vector3& g, double added)
{
    SixDoFState& s = *state_;
    s.pose = withoutRounding(carried(s, to));
    s.time = to;
    if (isHeld(to))
    {
        s.acceleration = s.omegaRate = {};
        if (to >= stop_) s.velocity = s.omega = {};
        return;
    }
    const Vector3 moment = load.moment - cross(s.pose(centreOfMass_), load.force);
    const double share = added/(mass_ + added);
    s.acceleration = masked((load.force + mass_*g)/(mass_ + added) + share*s.acceleration, translations_);
    s.omegaRate = masked(moment/(inertia_*(1 + added/mass_)) + share*s.omegaRate, rotations_);
    s.velocity += dt*s.acceleration;
    s.omega += dt*s.omegaRate;
}

bool SixDoFBody::stopAt(const Vector3& at, const Vector3& normal, double most, double dt)
{
    constexpr double rounding = 1e-12;
    const double approach = -dot(state_->velocity + cross(state_->omega, at - centre()), normal), excess = approach - most;
    if (!(excess > rounding*(std::abs(approach) + std::abs(most)))) return false;
    state_->velocity += excess*normal;
    state_->acceleration += excess/dt*normal;
    return true;
}

}
