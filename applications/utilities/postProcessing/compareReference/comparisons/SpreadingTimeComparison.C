// SPDX-License-Identifier: GPL-3.0-or-later
// type spreadingTime;  regime viscous | inertial;  within 25;
// When a drop that touches a plane at the time 0 wets a disc of its own radius (WettedFoot.H), against what
// experiments with viscous and with inertial spreading have (reference/Spreading.H), in percent.

#include "Comparison.H"
#include "WettedFoot.H"
#include "reference/Spreading.H"

#include <numbers>

namespace shizuku
{

class SpreadingTimeComparison : public JudgedComparison
{
public:
    explicit SpreadingTimeComparison(const Dictionary& dict)
    :
        JudgedComparison(dict), viscous_(dict.lookupChoice("regime", {"viscous", "inertial"}) == "viscous")
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const double R = results.radius(), disc = std::numbers::pi*R*R;
        const double reference = viscous_ ? viscousSpreadingTime()*results.rho*results.nu*R/results.sigma
                                          : inertialSpreadingTime()*R/results.capillarySpeed();
        return {relativeRow("time of a wetted disc of R", "s", reference, wettedArea(results).firstTime(disc), within_)};
    }

private:
    bool viscous_;
};

static const ComparisonTable::Add<SpreadingTimeComparison> registered{"spreadingTime"};

}
