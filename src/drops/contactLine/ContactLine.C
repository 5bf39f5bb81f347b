// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/contactLine/ContactLine.H"

#include "drops/contactLine/LoopTangents.H"

namespace shizuku
{

std::vector<LineTangent> contactLine
(
    const TriangleMesh& drop, const std::vector<double>& height, const WallShape& wall, double above, double spacing
)
{
    constexpr double shortest = 6;          // spacings: smaller loops are bumps
    std::vector<LineTangent> line;
    for (const Loop& loop : loopsAt(drop, height, above))
    {
        if (lengthOf(loop) < shortest*spacing) continue;
        const auto tangents = tangentsBeside(loop, drop, height, wall, above, spacing);
        line.insert(line.end(), tangents.begin(), tangents.end());
    }
    return line;
}

}
