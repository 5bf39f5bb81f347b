// SPDX-License-Identifier: GPL-3.0-or-later
// type meniscus;  radius 2e-3;  theta 30;  within 0.5;
// The surface in an upright tube about the z axis, standing on the floor z = 0, against that of Young and Laplace with
// the liquid's volume below it: the largest deviation in height, in spacings, over rings half a spacing wide up to 1.5
// spacings off the wall; and the deviation of the rise from the innermost ring to the outermost, for information.
// Measured on the mesh of the latest time. meniscus.csv holds both surfaces.

#include "Comparison.H"
#include "reference/TubeMeniscus.H"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shizuku
{

class MeniscusComparison : public JudgedComparison
{
public:
    explicit MeniscusComparison(const Dictionary& dict)
    :
        JudgedComparison(dict), radius_(dict.lookupPositive("radius", dimensions::length)),
        theta_(dict.lookup<double>("theta"))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const double d = results.spacing;
        const TubeMeniscus exact = tubeMeniscus(radius_, std::sqrt(results.sigma/(results.rho*results.gravity)), theta_);
        const double mean = results.liquidVolume()/(std::numbers::pi*radius_*radius_);
        const double onAxis = mean - exact.meanHeight;

        // Mean heights of the vertices of the upper surface, ring by ring.
        const std::size_t rings = std::size_t(std::max(1.0, (radius_ - 1.5*d)/(0.5*d)));
        std::vector<double> sum(rings), count(rings);
        for (const Vector3& x : results.surface(results.times().back()).vertices)
        {
            const std::size_t ring = std::size_t(std::hypot(x.x, x.y)/(0.5*d));
            if (x.z < 0.5*mean || ring >= rings) continue;
            sum[ring] += x.z;
            ++count[ring];
        }

        CsvFile table = results.output("meniscus.csv", {{"radius", "m"}, {"height", "m"}, {"exactHeight", "m"}});
        double worst = 0, first = std::nan(""), last = first, exactFirst = first, exactLast = first;
        for (std::size_t ring = 0; ring < rings; ++ring)
        {
            if (count[ring] == 0) continue;
            const double r = (double(ring) + 0.5)*0.5*d;
            const double height = sum[ring]/count[ring], reference = onAxis + exact.height(r);
            table.addRow({r, height, reference});
            if (std::abs(height - reference) > std::abs(worst)) worst = height - reference;
            if (std::isnan(first))
            {
                first = height;
                exactFirst = reference;
            }
            last = height;
            exactLast = reference;
        }
        table.write();
        if (std::isnan(first)) worst = first;
        return
        {
            {"largest deviation in height", "spacings", 0, worst/d, worst/d, "spacings", within_},
            {
                "rise from axis to wall", "m", exactLast - exactFirst, last - first,
                ((last - first) - (exactLast - exactFirst))/d, "spacings", std::nan("")
            }
        };
    }

private:
    double radius_, theta_;
};

static const ComparisonTable::Add<MeniscusComparison> registered{"meniscus"};

}
