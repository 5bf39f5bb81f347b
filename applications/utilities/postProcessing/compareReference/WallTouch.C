// SPDX-License-Identifier: GPL-3.0-or-later
#include "WallTouch.H"

#include <algorithm>

namespace shizuku
{

std::optional<WallTouch> findWallTouch(const CaseResults& results)
{
    const CsvTable extent = results.table("extent", "boundingBox.csv");
    const std::vector<double> t = extent.numbers("time"), z = extent.numbers("minZ");
    std::vector<double> near;
    for (const double height : z)
    {
        if (height < results.spacing) near.push_back(height);
    }
    if (near.empty()) return {};
    std::nth_element(near.begin(), near.begin() + long(near.size()/2), near.end());
    const double touching = near[near.size()/2] + 0.15*results.spacing;

    const auto touches = [&](double height) { return height <= touching; };
    const auto first = std::find_if(z.begin(), z.end(), touches) - z.begin();
    const auto behind = std::find_if(z.rbegin(), z.rend(), touches).base() - z.begin();
    const auto crossing = [&](long i) { return t[i - 1] + (touching - z[i - 1])/(z[i] - z[i - 1])*(t[i] - t[i - 1]); };
    WallTouch touch;
    if (first > 0) touch.first = crossing(first);
    if (behind < long(z.size())) touch.last = crossing(behind);
    return touch;
}

double velocityBehind(const CaseResults& results, double time)
{
    const CsvTable drop = results.table("drop", "liquidState.csv");
    double sum = 0;
    int count = 0;
    for (std::size_t row = 0; row < drop.rows(); ++row)
    {
        if (drop.number(row, "time") < time) continue;
        sum += drop.number(row, "momentumZ");
        ++count;
    }
    return count > 0 ? sum/count/(results.rho*results.liquidVolume()) : 0;
}

}
