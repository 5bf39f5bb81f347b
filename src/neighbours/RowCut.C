// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/RowCut.H"

#include "core/messages/Error.H"

#include <algorithm>
#include <string>

namespace shizuku
{

RowCut cutEvenly(std::vector<int> rows, int parts, bool acrossZ)
{
    if (parts < 1 || parts > RowCut::mostParts)
    {
        throw FatalError("A liquid cannot be cut into " + std::to_string(parts) + " parts: 1 to " + std::to_string(RowCut::mostParts) + " are possible");
    }
    std::sort(rows.begin(), rows.end());
    RowCut cut{parts, acrossZ, {}};
    for (int k = 1; k < parts && !rows.empty(); ++k) cut.first[k] = rows[rows.size() * k / parts];
    return cut;
}

}
