// SPDX-License-Identifier: GPL-3.0-or-later
// type rebound;  contactWithin 8;  restitutionWithin 0.06;
// A drop that falls along -z and bounces off the plane z = 0: contact time in percent, and coefficient of restitution, against experiments at its
// Weber number (reference/DropImpact.H).
//
// It touches the plane where its lowest particle (table `extent`, a boundingBox) is no more than 0.15 spacings above where the lowest one stands
// most of the time that it is within a spacing of the plane: what is farther away is not in touch, however far models reach. The
// speeds are those of the momentum (table `drop`, a liquidState) in the first row, and over all rows behind the last touch. A drop that is in touch
// at the end stays: no contact time, a restitution of 0. rebound.csv holds the trace.

#include "Comparison.H"
#include "core/fieldFile/CsvFile.H"
#include "reference/DropImpact.H"

#include <algorithm>
#include <cmath>
#include <optional>

namespace shizuku
{

namespace
{

struct Touch
{
    double first, last;             // s
};

// Of the heights z of the lowest particle [m] at the times t. Nothing for a drop that never comes there, or does not leave.
std::optional<Touch> findTouch(const std::vector<double>& t, const std::vector<double>& z, double spacing)
{
    std::vector<double> near;
    for (const double height : z)
    {
        if (height < spacing) near.push_back(height);
    }
    if (near.empty()) return {};
    std::nth_element(near.begin(), near.begin() + long(near.size()/2), near.end());
    const double touching = near[near.size()/2] + 0.15*spacing;

    const auto touches = [&](double height) { return height <= touching; };
    const auto first = std::find_if(z.begin(), z.end(), touches) - z.begin();
    const auto behind = std::find_if(z.rbegin(), z.rend(), touches).base() - z.begin();
    if (first == 0 || behind == long(z.size())) return {};
    const auto crossing = [&](long i) { return t[i - 1] + (touching - z[i - 1])/(z[i] - z[i - 1])*(t[i] - t[i - 1]); };
    return Touch{crossing(first), crossing(behind)};
}

}

class ReboundComparison : public Comparison
{
public:
    explicit ReboundComparison(const Dictionary& dict)
    :
        contactWithin_(dict.lookupPositive("contactWithin", dimensions::none)),
        restitutionWithin_(dict.lookupPositive("restitutionWithin", dimensions::none))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const CsvTable extent = results.table("extent", "boundingBox.csv"), drop = results.table("drop", "liquidState.csv");
        const std::vector<double> t = extent.numbers("time"), z = extent.numbers("minZ");
        const std::vector<double> times = drop.numbers("time");
        std::vector<double> speeds = drop.numbers("momentumZ");
        for (double& speed : speeds) speed /= results.rho*results.liquidVolume();

        const auto touch = findTouch(t, z, results.spacing);
        const double before = -speeds.front();
        double after = 0;
        if (touch)
        {
            double sum = 0;
            int count = 0;
            for (std::size_t i = 0; i < times.size(); ++i)
            {
                if (times[i] < touch->last) continue;
                sum += speeds[i];
                ++count;
            }
            after = count > 0 ? sum/count : 0;
        }
        const double radius = results.radius(), tau = radius/results.capillarySpeed();
        const double weber = std::pow(before/results.capillarySpeed(), 2);
        const Rebound measured = measuredRebound(weber);
        writeTrace(results, t, z, times, speeds);
        return
        {
            relativeRow
            (
                "contact time", "tau", measured.contactTime, touch ? (touch->last - touch->first)/tau : std::nan(""), contactWithin_
            ),
            absoluteRow("coefficient of restitution", "", measured.restitution, after/before, restitutionWithin_),
            {"Weber number of the radius", "", std::nan(""), weber, std::nan(""), "", std::nan("")}
        };
    }

private:
    // The speed at the times of the heights.
    static void writeTrace
    (
        const CaseResults& results, const std::vector<double>& t, const std::vector<double>& z, const std::vector<double>& times,
        const std::vector<double>& speeds
    )
    {
        CsvFile trace
        (
            results.casePath()/"postProcessing/compareReference/rebound.csv", {{"time", "s"}, {"lowest", "spacings"}, {"speed", "m/s"}}
        );
        for (std::size_t i = 0; i < t.size(); ++i)
        {
            const auto at = std::min<std::size_t>(std::lower_bound(times.begin(), times.end(), t[i]) - times.begin(), times.size() - 1);
            trace.addRow({t[i], z[i]/results.spacing, speeds[at]});
        }
        trace.write();
    }

    double contactWithin_, restitutionWithin_;
};

static const ComparisonTable::Add<ReboundComparison> registered{"rebound"};

}
