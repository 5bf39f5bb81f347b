// SPDX-License-Identifier: GPL-3.0-or-later
// type energy;  made 5;  [function energies;]
// A free drop that starts as a spheroid around z and swings: what its numerics have made at most, in percent of what its shape had at the start beyond a sphere's
// surface. Told besides: the most that they have taken, and what viscosity and the filter of noise took in all, by the function object `energy`.
//
// made(t) = K + S + W - S(0), at the written times at which the drop passes through the sphere, S < 0.1 S(0). K, W: `kinetic` and `viscosity` of the rows at these times.
// S: sigma times the area beyond a sphere's of the spheroid that has the volume and the second moments of the particles. Between these times nearly all energy is the surface's,
// and neither way to read it is good to 0.05 of S(0): what shapes of such swings have beyond a spheroid is 0.05 to 0.1 of it, and a mesh, in the first half of the swing, while
// the lattice of the start gives way, is off by all of it.

#include "Comparison.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace shizuku
{

namespace
{

// Of the semi-axes a, a, c.
double spheroidArea(double a, double c)
{
    const double shorter = std::min(a, c)/std::max(a, c), e = std::sqrt(1 - shorter*shorter);
    if (e < 1e-6) return 4*std::numbers::pi*a*a;
    return 2*std::numbers::pi*a*a*(1 + (c < a ? shorter*shorter/e*std::atanh(e) : std::asin(e)/(e*shorter)));
}

// Of the spheroid with the places' second moments, brought to the volume.
double areaByMoments(const std::vector<Vector3>& places, double volume)
{
    const Vector3 centre = meanOf(places);
    double across = 0, along = 0;
    for (const Vector3& x : places)
    {
        const Vector3 r = x - centre;
        across += (r.x*r.x + r.y*r.y)/2;
        along += r.z*r.z;
    }
    const double ratio = std::sqrt(along/across), a = std::cbrt(volume/(4*std::numbers::pi/3*ratio));
    return spheroidArea(a, ratio*a);
}

}

class EnergyComparison : public Comparison
{
public:
    explicit EnergyComparison(const Dictionary& dict)
        : function_(dict.lookupOr<std::string>("function", "energies")), made_(dict.lookupPositive("made", dimensions::none)) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        const CsvTable table = results.table(function_, "energy.csv");
        const auto surface = [&](const TimeFolder& time) { return results.sigma*areaByMoments(results.positions(time), results.liquidVolume()); };
        const double sphere = 4*std::numbers::pi*results.radius()*results.radius()*results.sigma, swing = surface(results.times().front()) - sphere;
        double most = 0, least = 0;
        int passed = 0;
        auto time = results.times().begin() + 1;
        for (std::size_t row = 0; row < table.rows() && time != results.times().end(); ++row)
        {
            if (table.number(row, "time") < time->value*(1 - 1e-6)) continue;
            const double beyond = surface(*time) - sphere;
            ++time;
            if (beyond > 0.1*swing) continue;
            const double made = table.number(row, "kinetic") + beyond + table.number(row, "viscosity") - swing;
            most = std::max(most, made);
            least = std::min(least, made);
            ++passed;
        }
        if (passed == 0) most = none;
        const auto taken = [&](const std::string& column) { return 100*table.number(table.rows() - 1, column)/swing; };
        return
        {
            absoluteRow("energy that numerics made", "%", 0, 100*most/swing, made_),
            absoluteRow("energy that numerics took", "%", 0, -100*least/swing, none),
            absoluteRow("energy that numerics made or took", "%", 0, 100*std::max(most, -least)/swing, none),
            absoluteRow("energy that viscosity took", "%", 0, taken("viscosity"), none),
            absoluteRow("energy that the filter took", "%", 0, taken("filter"), none)
        };
    }

private:
    std::string function_;
    double made_;               // percent
};

static const ComparisonTable::Add<EnergyComparison> registered{"energy"};

}
