// SPDX-License-Identifier: GPL-3.0-or-later
// type impact;  theta 90;  within 10;  [stays yes;]
// A drop that falls along -z on the plane z = 0: the largest diameter of the wetted disc (table `spread`, a spreadDiameter) over that of the drop
// against Laan and Lee (reference/DropImpact.H), beta_0 that of the cap of theta [degrees]; and how many of its particles are off its main body,
// further than the kernel reaches, two spacings, at the written time at which they are most: none may be. With `stays` something must be wetted at
// the end. spread.csv holds the trace.

#include "Comparison.H"
#include "meshes/ConnectedPoints.H"
#include "reference/CapOnWall.H"
#include "reference/DropImpact.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

class ImpactComparison : public JudgedComparison
{
public:
    explicit ImpactComparison(const Dictionary& dict)
    :
        JudgedComparison(dict), theta_(dict.lookup<double>("theta")), stays_(dict.lookupOr("stays", false))
    {
        if (!(theta_ > 0 && theta_ <= 180)) throw FatalInputError(dict.where("theta"), "theta is out of range", "above 0 and up to 180");
    }

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const double diameter = 2*results.radius(), none = std::nan("");
        const CsvTable states = results.table("drop", "liquidState.csv"), spread = results.table("spread", "spreadDiameter.csv");
        const double speed = -states.number(0, "momentumZ")/(results.rho*results.liquidVolume());
        const double weber = results.rho*speed*speed*diameter/results.sigma, reynolds = speed*diameter/results.nu;

        CsvFile trace = results.output("spread.csv", {{"time", "s"}, {"wetted", "diameters"}, {"liquid", "diameters"}});
        double most = 0, wettedAtEnd = 0, widest = 0;
        for (std::size_t row = 0; row < spread.rows(); ++row)
        {
            const double wetted = spread.number(row, "wettedDiameter")/diameter, liquid = spread.number(row, "liquidExtent")/diameter;
            trace.addRow({spread.number(row, "time"), wetted, liquid});
            most = std::max(most, wetted);
            if (liquid > widest) widest = liquid;           // not a number where the wall is dry
            wettedAtEnd = wetted;
        }
        trace.write();

        const double atRest = capFootRadius(theta_);
        const double off = double(particlesOff(results));
        std::vector<ComparisonRow> rows
        {
            relativeRow("largest spread", "diameters", largestSpread(weber, reynolds, atRest), most, within_),
            absoluteRow("particles off the main body", "", 0, off, 0),
            {"largest extent of the liquid", "diameters", none, widest, none, "", none},
            {"Weber number of the diameter", "", none, weber, none, "", none}
        };
        if (stays_) rows.push_back(absoluteRow("wetted at the end", "", 1, wettedAtEnd > 0, 0));
        return rows;
    }

private:
    static std::size_t particlesOff(const CaseResults& results)
    {
        std::size_t most = 0;
        for (const TimeFolder& time : results.times())
        {
            const std::vector<Vector3> positions = results.positions(time);
            most = std::max(most, positions.size() - connectedPoints(positions, 2*results.spacing).front().size());
        }
        return most;
    }

    double theta_;
    bool stays_;
};

static const ComparisonTable::Add<ImpactComparison> registered{"impact"};

}
