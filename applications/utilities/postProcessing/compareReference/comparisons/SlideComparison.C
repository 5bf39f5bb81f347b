// SPDX-License-Identifier: GPL-3.0-or-later
// type slide;
// A drop that slides along x down a plane: its speed over the last third of the run, of its centroid (table `drop`, a liquidState), as a capillary
// number rho nu U/sigma, and by how much it still changes from half of that third to the other. What it should be depends on a slip length; nothing
// is judged here.

#include "Comparison.H"

#include <cmath>

namespace shizuku
{

class SlideComparison : public Comparison
{
public:
    explicit SlideComparison(const Dictionary&) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const CsvTable drop = results.table("drop", "liquidState.csv");
        const std::size_t last = drop.rows() - 1, first = last - last/3, middle = (first + last)/2;
        const auto speed = [&](std::size_t from, std::size_t to)
        {
            return (drop.number(to, "centroidX") - drop.number(from, "centroidX"))/(drop.number(to, "time") - drop.number(from, "time"));
        };
        const double none = std::nan(""), early = speed(first, middle), late = speed(middle, last);
        return
        {
            {"capillary number of sliding", "", none, results.rho*results.nu*speed(first, last)/results.sigma, none, "", none},
            {"change of the speed", "%", 0, 100*(late/early - 1), none, "", none}
        };
    }
};

static const ComparisonTable::Add<SlideComparison> registered{"slide"};

}
