// SPDX-License-Identifier: GPL-3.0-or-later
// type partialWetting;  within 0.04;
// A drop of squalane that touches a plane of 41 degrees at the time 0: its wetted area (WettedFoot.H) over that of the
// cap of 41 degrees, against Lavi and Marmur 2004, rms over their nine times (reference/Spreading.H); and when it has come to the half of it. A run that
// ends before their last time is not judged. wetting.csv holds the trace.

#include "Comparison.H"
#include "WettedFoot.H"
#include "reference/CapOnWall.H"
#include "reference/Spreading.H"

#include <cmath>
#include <numbers>

namespace shizuku
{

static std::vector<ComparisonRow> comparePartialWetting(const CaseResults& results, double within)
{
    const double radius = results.radius()*capFootRadius(41), final = std::numbers::pi*radius*radius;
    const double unit = results.rho*results.nu*std::cbrt(results.liquidVolume())/results.sigma;       // s
    SampledCurve area;
    const SampledCurve foot = wettedArea(results);
    for (const auto& [time, wetted] : foot.points()) area.add(time/unit, wetted/final);

    const double none = std::nan("");
    CsvFile trace = results.output("wetting.csv", {{"time", ""}, {"area", ""}, {"measured", ""}});
    for (const auto& [time, share] : area.points()) trace.addRow({time, share, none});
    SampledCurve theirs;
    double sum = 0;
    for (const WettedShare& measured : lavi2004())
    {
        theirs.add(measured.time, measured.area);
        trace.addRow({measured.time, none, measured.area});
        sum += std::pow(area.at(measured.time) - measured.area, 2);
    }
    trace.write();
    const double rms = std::sqrt(sum/double(lavi2004().size()));
    return
    {
        {"rms difference of the wetted area", "", 0, rms, rms, "", within},
        relativeRow("time of half of it", "", theirs.firstTime(0.5), area.firstTime(0.5), none),
        {"last wetted area", "", 1, area.points().back().second, area.points().back().second - 1, "", none}
    };
}

static const ComparisonTable::Add<PlainComparison<comparePartialWetting>> registered{"partialWetting"};

}
