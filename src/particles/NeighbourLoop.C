// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/NeighbourLoop.H"

namespace shizuku
{

std::optional<HiddenValues> NeighbourLoop::hideOthers(const Columns& made) const
{
    const Ghosts& ghosts = liquid_.ghosts();
    if (!ghosts.poisons()) return std::nullopt;
    Columns named = made;
    for (const Columns& more : {columns(changed_), columns(kept_), ghosts.declared()}) named.insert(named.end(), more.begin(), more.end());
    return std::optional<HiddenValues>(std::in_place, liquid_.fields(), liquid_.owned(), named);
}

}
