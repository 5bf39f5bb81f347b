// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/ParetoFront.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

bool known(const CostAndError& p) { return std::isfinite(p.cost) && std::isfinite(p.error); }

bool beats(const CostAndError& a, const CostAndError& b)
{
    return known(a) && a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

}

std::vector<bool> paretoFront(const std::vector<CostAndError>& points)
{
    std::vector<bool> front;
    for (const CostAndError& p : points)
    {
        const auto beatsThis = [&](const CostAndError& other) { return beats(other, p); };
        front.push_back(known(p) && std::none_of(points.begin(), points.end(), beatsThis));
    }
    return front;
}

}
