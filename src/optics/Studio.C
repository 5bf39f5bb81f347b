// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/Studio.H"

#include "core/angles/Degrees.H"
#include "optics/StudioPanel.H"

#include <algorithm>
#include <array>
#include <cmath>

namespace shizuku
{

namespace
{

// Azimuths from the right towards the viewer.
constexpr std::array<StudioPanel, 2> panels{{{108, 165, 36, 68, 9, 5}, {15, 45, 15, 65, 3, 5}}};

}

Colour Studio::light(const Vector3& direction) const
{
    const double elevation = degrees(std::asin(std::clamp(dot(direction, up_), -1.0, 1.0)));
    double azimuth = degrees(std::atan2(dot(direction, front_), dot(direction, right_)));
    if (azimuth < 0) azimuth += 360;
    const double soft = std::clamp(elevation/75, 0.0, 1.0), below = std::clamp(-elevation/40, 0.0, 1.0);
    double light = 0.94 - 0.62*soft*soft*(3 - 2*soft) - 0.5*below;
    for (const StudioPanel& panel : panels) light += panel.light(azimuth, elevation);
    return {0.97*light, 0.985*light, light};
}

}
