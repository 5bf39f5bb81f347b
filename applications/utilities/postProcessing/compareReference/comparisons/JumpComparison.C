// SPDX-License-Identifier: GPL-3.0-or-later
// type jump;  within 25;
// Two equal drops that merge on a plane z = 0 which nothing wets jump off it, at 0.2 sqrt(sigma/(rho R)), R the radius of one of them (Boreyko and Chen
// 2009, Phys. Rev. Lett. 103, 184501; Enright et al. 2014, ACS Nano 8, 10352): the speed behind the last touch (WallTouch.H), in percent. 0 where
// they stay.

#include "Comparison.H"
#include "WallTouch.H"

#include <cmath>

namespace shizuku
{

static std::vector<ComparisonRow> compareJump(const CaseResults& results, double within)
{
    const auto touch = findWallTouch(results);
    const double speed = touch && touch->last ? velocityBehind(results, *touch->last) : 0;
    const double ofOne = results.capillarySpeed()*std::pow(2, 1.0/6);
    return {relativeRow("speed of the jump", "capillary speeds", 0.2, speed/ofOne, within)};
}

static const ComparisonTable::Add<PlainComparison<compareJump>> registered{"jump"};

}
