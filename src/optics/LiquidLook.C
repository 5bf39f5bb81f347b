// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/LiquidLook.H"

#include <algorithm>

namespace shizuku
{

const std::vector<LiquidLook>& liquidLooks()
{
    // Indices of refraction at 20 degrees Celsius and 589 nm. Millimetres of water have no colour: that of a few metres tells it from glass. Honey
    // scatters light.
    static const std::vector<LiquidLook> looks
    {
        {"water", 1.333, {0.87, 0.95, 0.98}, {}, false},
        {"honey", 1.49, {0.86, 0.42, 0.04}, {}, false, 0.3, 0.93},
        {"mercury", 1, {}, {0.78, 0.78, 0.79}, true},
        {"ink", 1.34, {0.02, 0.03, 0.20}, {}, false},
    };
    return looks;
}

const LiquidLook& liquidLook(const std::string& word)
{
    const auto& looks = liquidLooks();
    return *std::find_if(looks.begin(), looks.end(), [&](const LiquidLook& look) { return look.word == word; });
}

}
