// SPDX-License-Identifier: GPL-3.0-or-later
// type slide;  theta 60;
// A drop that slides along x down a plane of that angle [degrees]: its speed over the last third of the run, of its centroid (table `drop`, a liquidState), as a
// capillary number rho nu U/sigma, and by how much it still changes from half of that third to the other. Beside it the balance of its weight with the angles of Cox and
// Voinov (reference/MovingContactLine.H), the base a circle of the cap at rest, the slip length a spacing; the slip length with which the measured speed would be
// its; and, where probeAngle has measured, front and rear angles of the last time beside those of the measured speed. What is right depends on a slip length
// that no run resolves; nothing is judged here.

#include "Comparison.H"
#include "LargestDrops.H"
#include "core/angles/Degrees.H"
#include "reference/CapOnWall.H"
#include "reference/MovingContactLine.H"

#include <cmath>

namespace shizuku
{

class SlideComparison : public Comparison
{
public:
    explicit SlideComparison(const Dictionary& dict) : theta_(dict.lookup<double>("theta")) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const CsvTable drop = results.table("drop", "liquidState.csv");
        const std::size_t last = drop.rows() - 1, first = last - last/3, middle = (first + last)/2;
        const auto speed = [&](std::size_t from, std::size_t to)
        {
            return (drop.number(to, "centroidX") - drop.number(from, "centroidX"))/(drop.number(to, "time") - drop.number(from, "time"));
        };
        const double none = std::nan(""), early = speed(first, middle), late = speed(middle, last);
        const double measured = results.rho*results.nu*speed(first, last)/results.sigma;

        const double base = std::sin(radians(theta_))*capRadius(theta_)*results.radius(), logarithm = std::log(base/results.spacing);
        const double force = results.rho*results.liquidVolume()*results.gravity/(results.sigma*base);
        const double slip = measured > 0 ? base/std::exp(slidingLogarithm(theta_, measured, force)) : none;
        std::vector<ComparisonRow> rows
        {
            relativeRow("capillary number of sliding", "", slidingSpeed(theta_, force, logarithm), measured, none),
            {"change of the speed", "%", 0, 100*(late/early - 1), none, "", none},
            {"slip length by the speed", "spacings", 1, slip/results.spacing, slip/results.spacing - 1, "spacings", none}
        };
        if (const auto drops = LargestDrops::find(results))
        {
            rows.push_back(absoluteRow("angle of the front", "deg", movingAngle(theta_, measured, logarithm), drops->number(drops->last(), "advancing"), none));
            rows.push_back(absoluteRow("angle of the rear", "deg", movingAngle(theta_, -measured, logarithm), drops->number(drops->last(), "receding"), none));
        }
        return rows;
    }

private:
    double theta_;
};

static const ComparisonTable::Add<SlideComparison> registered{"slide"};

}
