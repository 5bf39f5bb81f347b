// SPDX-License-Identifier: GPL-3.0-or-later
// type bridgeForce;  lower floor;  upper ceiling;  theta 60;  from 0.5;  within 3;  [function forces;]
// Liquid that hangs at rest between two parallel plane walls of one contact angle, without gravity: the force with which it pulls each of them towards the other, by the function object `wallForces`,
// against that of the exact shape. Means of the rows behind `from` of the run's time.

#include "Comparison.H"
#include "LastRows.H"
#include "caseFiles/WallPlane.H"
#include "reference/LiquidBridge.H"

#include <stdexcept>

namespace shizuku
{

class BridgeForceComparison : public JudgedComparison
{
public:
    explicit BridgeForceComparison(const Dictionary& dict)
    :
        JudgedComparison(dict), lower_(dict.lookup<std::string>("lower")), upper_(dict.lookup<std::string>("upper")), lowerAt_(dict.where("lower")), upperAt_(dict.where("upper")),
        function_(dict.lookupOr<std::string>("function", "forces")), theta_(dict.lookupPositive("theta", dimensions::none)), from_(dict.lookupOr("from", 0.5))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const CaseWalls walls = readCaseWalls(results.casePath());
        const Plane lower = planeNamed(walls, lower_, lowerAt_, results), upper = planeNamed(walls, upper_, upperAt_, results);
        const LiquidBridge exact = bridge(lower.distance(upper.point), results);
        const CsvTable table = results.table(function_, "wallForces.csv");
        std::vector<ComparisonRow> rows;
        for (const auto& [name, plane] : {std::pair{lower_, lower}, {upper_, upper}})
        {
            rows.push_back(relativeRow("force on " + name, "N", results.sigma*exact.force, pullOn(table, name, plane.normal), within_));
        }
        return rows;
    }

private:
    LiquidBridge bridge(double gap, const CaseResults& results) const
    {
        try
        {
            return LiquidBridge::between(gap, results.liquidVolume(), theta_);
        }
        catch (const std::domain_error& error)
        {
            throw FatalInputError(upperAt_, std::string("There is ") + error.what(), "plates nearer to each other, or more liquid");
        }
    }

    static Plane planeNamed(const CaseWalls& walls, const std::string& name, const SourceLocation& where, const CaseResults& results)
    {
        const auto plane = planeOf(walls, name, results.spacing);
        if (!plane) throw FatalInputError(where, "The wall '" + name + "' is no plane", "a plane wall of constant/walls", walls.names, name);
        return *plane;
    }

    // Along the plane's normal, N: the mean of the last rows.
    double pullOn(const CsvTable& table, const std::string& wall, const Vector3& normal) const
    {
        return meanOfLast(table, from_, [&](std::size_t row)
        {
            double pull = 0;
            for (const std::string part : {"pressure", "contactLine", "friction"})
            {
                const std::string name = wall + "_" + part + "Force";
                pull += dot(normal, {table.number(row, name + "X"), table.number(row, name + "Y"), table.number(row, name + "Z")});
            }
            return pull;
        });
    }

    std::string lower_, upper_;
    SourceLocation lowerAt_, upperAt_;
    std::string function_;
    double theta_, from_;
};

static const ComparisonTable::Add<BridgeForceComparison> registered{"bridgeForce"};

}
