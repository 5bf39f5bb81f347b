// SPDX-License-Identifier: GPL-3.0-or-later
// type bridgeRupture;  lower floor;  upper ceiling;  theta 60;  within 5;
// Liquid that hangs between two parallel plane walls, of which one moves away slowly: the gap at which it breaks, by the first row of the function object `parts` (drops) with two bodies, against
// (1 + theta/2) V^(1/3), theta in radians (Lian, Thornton and Adams 1993, J. Colloid Interface Sci. 161, 138).

#include "Comparison.H"
#include "core/angles/Degrees.H"
#include "wallMotions/WallMotions.H"

#include <cmath>
#include <limits>

namespace shizuku
{

class BridgeRuptureComparison : public JudgedComparison
{
public:
    explicit BridgeRuptureComparison(const Dictionary& dict)
    :
        JudgedComparison(dict), lower_(dict.lookup<std::string>("lower")), upper_(dict.lookup<std::string>("upper")), lowerAt_(dict.where("lower")), upperAt_(dict.where("upper")),
        theta_(dict.lookupPositive("theta", dimensions::none))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const CsvTable table = results.table("parts", "drops.csv");
        double gap = std::numeric_limits<double>::quiet_NaN();
        for (std::size_t row = 0; row < table.rows() && std::isnan(gap); ++row)
        {
            if (table.number(row, "drops") > 1) gap = gapAt(table.number(row, "time"), results);
        }
        return {relativeRow("gap at rupture", "m", (1 + radians(theta_)/2)*std::cbrt(results.liquidVolume()), gap, within_)};
    }

private:
    double gapAt(double time, const CaseResults& results) const
    {
        const CaseWalls walls = readCaseWalls(results.casePath(), time);
        const auto plane = [&](const std::string& name, const SourceLocation& where)
        {
            const auto found = planeOf(walls, name, results.spacing);
            if (!found) throw FatalInputError(where, "The wall '" + name + "' is no plane", "a plane wall of constant/walls", walls.names, name);
            return *found;
        };
        return plane(lower_, lowerAt_).distance(plane(upper_, upperAt_).point);
    }

    std::string lower_, upper_;
    SourceLocation lowerAt_, upperAt_;
    double theta_;
};

static const ComparisonTable::Add<BridgeRuptureComparison> registered{"bridgeRupture"};

}
