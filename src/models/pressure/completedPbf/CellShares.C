// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/pressure/completedPbf/CellShares.H"

#include <algorithm>

namespace shizuku
{

void CellShares::set(const Ghosts& ghosts, const GridBox& box, const CellBounds& own)
{
    box_ = box;
    part_ = ghosts.parts().part();
    cells_.clear();
    counts_.clear();
    for (CellBounds bounds : ghosts.parts().gather(own))
    {
        const int ends[3] = {box.x, box.y, box.z};
        for (int c = 0; c < 3; ++c)
        {
            bounds.low[c] = std::max(bounds.low[c], 0);
            bounds.high[c] = std::min(bounds.high[c], ends[c] - 1);
        }
        const int *low = bounds.low, *high = bounds.high;
        CellsOfBox cells;
        if (!bounds.isEmpty()) cells = {{high[0] - low[0] + 1, high[1] - low[1] + 1, high[2] - low[2] + 1}, low[0], low[1], low[2]};
        cells_.push_back(cells);
        counts_.push_back(cells.cells());
    }
}

}
