// SPDX-License-Identifier: GPL-3.0-or-later
// type rebound;  contactWithin 8;  restitutionWithin 0.06;
// A drop that falls along -z and bounces off the plane z = 0: contact time (WallTouch.H) in percent, and coefficient of restitution, against
// experiments at its Weber number (reference/DropImpact.H). The speeds are those of the momentum (table `drop`, a liquidState) in the first row, and
// over all rows behind the last touch. A drop that is in touch at the end stays: no contact time, a restitution of 0. rebound.csv
// holds the trace.

#include "Comparison.H"
#include "WallTouch.H"
#include "reference/DropImpact.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

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
        const double before = -results.table("drop", "liquidState.csv").number(0, "momentumZ")/(results.rho*results.liquidVolume());
        const auto touch = findWallTouch(results);
        const bool bounced = touch && touch->first && touch->last;
        const double after = bounced ? velocityBehind(results, *touch->last) : 0, none = std::nan("");
        const double tau = results.radius()/results.capillarySpeed(), weber = std::pow(before/results.capillarySpeed(), 2);
        const Rebound measured = measuredRebound(weber);
        writeTrace(results);
        return
        {
            relativeRow("contact time", "tau", measured.contactTime, bounced ? (*touch->last - *touch->first)/tau : none, contactWithin_),
            absoluteRow("coefficient of restitution", "", measured.restitution, after/before, restitutionWithin_),
            {"Weber number of the radius", "", none, weber, none, "", none}
        };
    }

private:
    static void writeTrace(const CaseResults& results)
    {
        const CsvTable extent = results.table("extent", "boundingBox.csv"), drop = results.table("drop", "liquidState.csv");
        CsvFile trace = results.output("rebound.csv", {{"time", "s"}, {"lowest", "spacings"}, {"speed", "m/s"}});
        for (std::size_t row = 0; row < std::min(extent.rows(), drop.rows()); ++row)
        {
            trace.addRow
            ({
                extent.number(row, "time"), extent.number(row, "minZ")/results.spacing,
                drop.number(row, "momentumZ")/(results.rho*results.liquidVolume())
            });
        }
        trace.write();
    }

    double contactWithin_, restitutionWithin_;
};

static const ComparisonTable::Add<ReboundComparison> registered{"rebound"};

}
