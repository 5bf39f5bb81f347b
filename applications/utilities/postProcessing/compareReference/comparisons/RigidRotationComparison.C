// SPDX-License-Identifier: GPL-3.0-or-later
// type rigidRotation;  momentumWithin 0.1;  residualWithin 0.02;
// A free drop that turns: its angular momentum about its centroid at the last written time against that at the first one behind the start, in
// percent, by positions and velocities; and what is left of the velocities at the last one when the rigid motion that fits best is taken
// off, rms, over the rms of that. Told besides: the turns by that motion's speed, and the angular momentum at that first time against that as filled.

#include "Comparison.H"
#include "caseFiles/VectorField.H"
#include "maths/LinearSolve.H"

#include <cmath>
#include <numbers>
#include <utility>

namespace shizuku
{

namespace
{

struct Rotation
{
    Vector3 momentum;           // sum r x u over the particles, m2/s
    double speed = 0;           // of the rigid motion that fits best, rad/s
    double rigid = 0, residual = 0;     // rms, m/s
};

Rotation rotationOf(const CaseResults& results, const TimeFolder& time)
{
    const std::vector<Vector3> x = results.positions(time);
    const std::vector<Vector3> u = toVectors(readField(time.path/"liquid/U", FieldType::vector, dimensions::velocity, long(x.size())), x.size());
    const double share = 1/double(x.size());
    Vector3 centre, drift;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        centre = centre + share*x[i];
        drift = drift + share*u[i];
    }

    // Least squares of u - drift against w x r, a component at a time.
    Rotation result;
    NormalEquations<3> equations;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const Vector3 r = x[i] - centre, v = u[i] - drift;
        result.momentum = result.momentum + cross(r, v);
        equations.add({0, r.z, -r.y}, v.x);
        equations.add({-r.z, 0, r.x}, v.y);
        equations.add({r.y, -r.x, 0}, v.z);
    }
    const auto w = equations.solve();
    if (!w) return result;
    const Vector3 angular{(*w)[0], (*w)[1], (*w)[2]};
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const Vector3 rigid = cross(angular, x[i] - centre), rest = u[i] - drift - rigid;
        result.rigid += share*dot(rigid, rigid);
        result.residual += share*dot(rest, rest);
    }
    result.speed = length(angular);
    result.rigid = std::sqrt(result.rigid);
    result.residual = std::sqrt(result.residual);
    return result;
}

}

class RigidRotationComparison : public Comparison
{
public:
    explicit RigidRotationComparison(const Dictionary& dict)
    :
        momentumWithin_(dict.lookupPositive("momentumWithin", dimensions::none)),
        residualWithin_(dict.lookupPositive("residualWithin", dimensions::none))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const auto& times = results.times();
        if (times.size() < 3) throw FatalInputError({results.casePath().string(), 0}, "The case has too few times", "two behind its start");
        const Rotation filled = rotationOf(results, times.front()), first = rotationOf(results, times[1]), last = rotationOf(results, times.back());
        const double none = std::nan("");
        const double unit = results.rho*results.particleVolume();           // kg
        double turns = 0, speed = filled.speed;
        for (std::size_t i = 1; i < times.size(); ++i)
        {
            const double before = std::exchange(speed, rotationOf(results, times[i]).speed);
            turns += 0.5*(before + speed)*(times[i].value - times[i - 1].value)/(2*std::numbers::pi);
        }
        const double off = length(last.momentum - first.momentum)/length(first.momentum);
        return
        {
            {
                "angular momentum", "kg m2/s", unit*length(first.momentum), unit*length(last.momentum), 100*off, "%", momentumWithin_
            },
            absoluteRow("velocity that is not rigid", "", 0, last.residual/last.rigid, residualWithin_),
            {"turns", "", none, turns, none, "", none},
            {
                "angular momentum at the first time", "kg m2/s", unit*length(filled.momentum), unit*length(first.momentum),
                100*(length(first.momentum)/length(filled.momentum) - 1), "%", none
            }
        };
    }

private:
    double momentumWithin_, residualWithin_;
};

static const ComparisonTable::Add<RigidRotationComparison> registered{"rigidRotation"};

}
