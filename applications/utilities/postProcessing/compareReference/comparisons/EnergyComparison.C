// SPDX-License-Identifier: GPL-3.0-or-later
// type energy;  made 5;  [function energies;]
// A free drop that swings: what its numerics have made at most, by the function object `energy`, in percent of what its shape had at the start beyond a sphere's
// surface. Told besides: the most that they have taken, and what the model of viscosity took in all.

#include "Comparison.H"

#include <algorithm>
#include <limits>
#include <numbers>

namespace shizuku
{

class EnergyComparison : public Comparison
{
public:
    explicit EnergyComparison(const Dictionary& dict)
        : function_(dict.lookupOr<std::string>("function", "energies")), made_(dict.lookupPositive("made", dimensions::none)) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        const CsvTable table = results.table(function_, "energy.csv");
        const double sphere = 4*std::numbers::pi*results.radius()*results.radius()*results.sigma;
        const double swing = table.number(0, "surface") + table.number(0, "kinetic") - sphere;
        double most = 0, least = 0;
        for (std::size_t row = 0; row < table.rows(); ++row)
        {
            const double made = table.number(row, "numerics");
            most = std::max(most, made);
            least = std::min(least, made);
        }
        const double viscous = table.number(table.rows() - 1, "viscosity") - table.number(0, "viscosity");
        return
        {
            absoluteRow("energy that numerics made", "%", 0, 100*most/swing, made_),
            absoluteRow("energy that numerics took", "%", 0, -100*least/swing, none),
            absoluteRow("energy that viscosity took", "%", 0, 100*viscous/swing, none)
        };
    }

private:
    std::string function_;
    double made_;               // percent
};

static const ComparisonTable::Add<EnergyComparison> registered{"energy"};

}
