// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/DrawnSurface.H"

#include "caseFiles/BoxSides.H"
#include "caseFiles/LiquidFiles.H"
#include "meshes/LidsAtSides.H"

namespace shizuku
{

TriangleMesh drawnSurface(TriangleMesh mesh, const std::filesystem::path& casePath)
{
    const auto box = BoxSides::read(casePath);
    std::vector<RepeatedSides> sides;
    for (int axis = 0; box && axis < 3; ++axis)
    {
        if (box->isCyclic(axis)) sides.push_back({axis, box->at[axis][0], box->at[axis][1]});
    }
    return sides.empty() ? mesh : withoutLids(std::move(mesh), sides, readSpacing(casePath));
}

}
