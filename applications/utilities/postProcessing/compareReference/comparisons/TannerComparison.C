// SPDX-License-Identifier: GPL-3.0-or-later
// type tanner;  within 10;
// A drop that touches a plane that it wets completely at the time 0: the exponent of its wetted radius (WettedFoot.H) over time in the last decade of the
// run, by least squares in logarithms, against Tanner's 1/10 (L. H. Tanner 1979, J. Phys. D 12, 1473-1484), in percent. tanner.csv holds the trace.

#include "Comparison.H"
#include "PowerLaw.H"
#include "WettedFoot.H"

#include <cmath>
#include <numbers>

namespace shizuku
{

static std::vector<ComparisonRow> compareTanner(const CaseResults& results, double within)
{
    const SampledCurve area = wettedArea(results);
    CsvFile trace = results.output("tanner.csv", {{"time", "s"}, {"radius", "m"}});
    PowerLaw law;
    double radius = std::nan("");
    for (const auto& [time, wetted] : area.points())
    {
        radius = std::sqrt(wetted/std::numbers::pi);
        trace.addRow({time, radius});
        if (time >= 0.1*area.points().back().first && wetted > 0) law.add(time, radius);
    }
    trace.write();
    const double none = std::nan("");
    return
    {
        relativeRow("exponent of the radius", "", 0.1, law.exponent(), within),
        {"last radius over the drop's", "", none, radius/results.radius(), none, "", none}
    };
}

static const ComparisonTable::Add<PlainComparison<compareTanner>> registered{"tanner"};

}
