// SPDX-License-Identifier: GPL-3.0-or-later
// type tanner;  within 10;
// A drop that touches a plane that it wets completely at the time 0: the exponent of its wetted radius (WettedFoot.H) over time in the last decade of the
// run, by least squares in logarithms, against Tanner's 1/10 (L. H. Tanner 1979, J. Phys. D 12, 1473-1484), in percent. tanner.csv holds the trace.

#include "Comparison.H"
#include "WettedFoot.H"
#include "core/fieldFile/CsvFile.H"
#include "maths/LinearSolve.H"

#include <cmath>
#include <numbers>

namespace shizuku
{

class TannerComparison : public Comparison
{
public:
    explicit TannerComparison(const Dictionary& dict) : within_(dict.lookupPositive("within", dimensions::none)) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const SampledCurve area = wettedArea(results);
        CsvFile trace(results.casePath()/"postProcessing/compareReference/tanner.csv", {{"time", "s"}, {"radius", "m"}});
        NormalEquations<2> line;
        double radius = std::nan("");
        for (const auto& [time, wetted] : area.points())
        {
            radius = std::sqrt(wetted/std::numbers::pi);
            trace.addRow({time, radius});
            if (time >= 0.1*area.points().back().first && wetted > 0) line.add({1, std::log(time)}, std::log(radius));
        }
        trace.write();
        const auto solution = line.solve();
        const double none = std::nan("");
        return
        {
            relativeRow("exponent of the radius", "", 0.1, solution ? (*solution)[1] : none, within_),
            {"last radius over the drop's", "", none, radius/results.radius(), none, "", none}
        };
    }

private:
    double within_;
};

static const ComparisonTable::Add<TannerComparison> registered{"tanner"};

}
