// SPDX-License-Identifier: GPL-3.0-or-later
// type angleOnSphere;  theta 60;  within 3;
// The angles at which the largest drop meets a curved solid without gravity, as probeAngle measured them at the latest time,
// against theta [degrees]: that of its cap, and for information the mean along the contact line. nan where the two do not
// meet.

#include "Comparison.H"
#include "LargestDrops.H"

#include <limits>

namespace shizuku
{

class AngleOnSphereComparison : public JudgedComparison
{
public:
    explicit AngleOnSphereComparison(const Dictionary& dict)
    : JudgedComparison(dict), theta_(dict.lookup<double>("theta")) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        const LargestDrops drops = LargestDrops::read(results);
        return
        {
            absoluteRow("contact angle", "deg", theta_, drops.number(drops.last(), "angle"), within_),
            absoluteRow("angle along the contact line", "deg", theta_, drops.number(drops.last(), "tangentMean"), none)
        };
    }

private:
    double theta_;
};

static const ComparisonTable::Add<AngleOnSphereComparison> registered{"angleOnSphere"};

}
