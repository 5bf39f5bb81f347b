// SPDX-License-Identifier: GPL-3.0-or-later
// type viscousSpreading;  age 0.05;  within 4;
// A drop that gravity spreads over the plane z = 0 against viscosity alone, from the profile on that it would have had when it was that old [s]: its
// radius against Huppert 1982 (reference/Spreading.H), the largest deviation in percent; and the exponent of the radius over the age, 1/8. The radius
// is that in table `foot`, a crossSection half a spacing above the plane. radius.csv holds the trace.

#include "Comparison.H"
#include "PowerLaw.H"
#include "reference/Spreading.H"

#include <cmath>

namespace shizuku
{

class ViscousSpreadingComparison : public JudgedComparison
{
public:
    explicit ViscousSpreadingComparison(const Dictionary& dict)
    : JudgedComparison(dict), age_(dict.lookupPositive("age", dimensions::time)) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const CsvTable foot = results.table("foot", "crossSection.csv");
        CsvFile trace = results.output("radius.csv", {{"time", "s"}, {"radius", "m"}, {"exactRadius", "m"}});
        PowerLaw law;
        double worst = 0, radius = 0, exact = 0;
        for (std::size_t row = 0; row < foot.rows(); ++row)
        {
            const double time = age_ + foot.number(row, "time");
            radius = foot.number(row, "radius");
            exact = huppertRadius(results.gravity, results.liquidVolume(), results.nu, time);
            trace.addRow({time, radius, exact});
            if (!(std::abs(100*(radius/exact - 1)) <= std::abs(worst))) worst = 100*(radius/exact - 1);
            law.add(time, radius);
        }
        trace.write();
        const double none = std::nan("");
        return
        {
            {"largest deviation of the radius", "%", 0, worst, worst, "%", within_},
            relativeRow("last radius", "m", exact, radius, none),
            relativeRow("exponent of the radius", "", 0.125, law.exponent(), none)
        };
    }

private:
    double age_;
};

static const ComparisonTable::Add<ViscousSpreadingComparison> registered{"viscousSpreading"};

}
