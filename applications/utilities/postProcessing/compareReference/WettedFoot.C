// SPDX-License-Identifier: GPL-3.0-or-later
#include "WettedFoot.H"

#include "core/messages/Error.H"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shizuku
{

SampledCurve wettedArea(const CaseResults& results)
{
    const CsvTable foot = results.table("foot", "crossSection.csv");
    const auto stands = [&](std::size_t row, double spacings) { return std::abs(foot.number(row, "place")/results.spacing - spacings) < 1e-3; };
    SampledCurve area;
    for (std::size_t row = 0; row + 1 < foot.rows(); row += 2)
    {
        if (!stands(row, 0.5) || !stands(row + 1, 1.5))
        {
            throw FatalInputError({results.casePath().string(), 0}, "foot has other planes", "places half a spacing and one and a half above z = 0");
        }
        const double radius = std::max(0.0, 1.5*foot.number(row, "radius") - 0.5*foot.number(row + 1, "radius"));
        area.add(foot.number(row, "time"), std::numbers::pi*radius*radius);
    }
    return area;
}

}
