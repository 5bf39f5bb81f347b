// SPDX-License-Identifier: GPL-3.0-or-later
// type neck;  radius 1e-3;  least 1.1;  most 1.6;
// The neck of two drops of that radius [m] that merge along x about x = 0, by table `neck`, a crossSection there: from 0.3 radii, but not less than
// two and a half spacings, to 0.75 it grows as r = C (sigma R/rho)^(1/4) t^(1/2), and C is the slope of r^2 by least squares, so that it does not
// matter when they met. Told
// besides: by how much r^2 scatters about the line. Experiments and computations have C from 1.1 to 1.6. neck.csv holds the trace.

#include "Comparison.H"
#include "maths/LinearSolve.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

class NeckComparison : public Comparison
{
public:
    explicit NeckComparison(const Dictionary& dict)
    :
        radius_(dict.lookupPositive("radius", dimensions::length)), least_(dict.lookupPositive("least", dimensions::none)),
        most_(dict.lookupPositive("most", dimensions::none))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const CsvTable neck = results.table("neck", "crossSection.csv");
        const double tau = std::sqrt(results.rho*std::pow(radius_, 3)/results.sigma);
        CsvFile trace = results.output("neck.csv", {{"time", "capillary times"}, {"radius", "radii"}});
        std::vector<std::pair<double, double>> points;      // t/tau, (r/R)^2
        const double from = std::max(0.3, 2.5*results.spacing/radius_);
        bool passed = false;
        for (std::size_t row = 0; row < neck.rows(); ++row)
        {
            const double t = neck.number(row, "time")/tau, square = std::pow(neck.number(row, "radius")/radius_, 2);
            trace.addRow({t, std::sqrt(square)});
            if (square > 0.75*0.75) passed = true;
            if (!passed && square > from*from) points.emplace_back(t, square);
        }
        trace.write();

        NormalEquations<2> line;
        for (const auto& [t, square] : points) line.add({1, t}, square);
        const auto solution = points.size() > 3 && passed ? line.solve() : std::nullopt;
        double scatter = std::nan("");
        if (solution)
        {
            double sum = 0;
            for (const auto& [t, square] : points) sum += std::pow(square - (*solution)[0] - (*solution)[1]*t, 2);
            scatter = std::sqrt(sum/double(points.size()));
        }
        const double none = std::nan(""), middle = 0.5*(least_ + most_);
        return
        {
            absoluteRow("growth of the neck", "", middle, solution ? std::sqrt(std::max(0.0, (*solution)[1])) : none, 0.5*(most_ - least_)),
            {"rms scatter of its square", "", 0, scatter, scatter, "", none}
        };
    }

private:
    double radius_, least_, most_;
};

static const ComparisonTable::Add<NeckComparison> registered{"neck"};

}
