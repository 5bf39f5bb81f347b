// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/foot/WedgeLevel.H"

#include "core/angles/Degrees.H"
#include "maths/Kernel.H"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shizuku
{

WedgeLevel::WedgeLevel(double support) : support_(support)
{
    constexpr int rings = 400, slices = 400;
    const CubicSpline W(1);
    double sum = 0;
    parts_.push_back(0);
    for (int i = 0; i < rings; ++i)
    {
        const double r = (i + 0.5)/rings;
        double along = 0;                   // of the kernel along a line at the distance r
        for (int k = 0; k < slices; ++k) along += W.W(scalar(std::hypot(r, (k + 0.5)/slices)));
        sum += 2*along/slices*r/rings;
        parts_.push_back(sum);
    }
    for (double& part : parts_) part *= 0.5/std::numbers::pi/sum;
}

double WedgeLevel::diskPart(double radius) const
{
    const double place = std::clamp(radius, 0.0, 1.0)*double(parts_.size() - 1);
    const std::size_t below = std::min(std::size_t(place), parts_.size() - 2);
    return parts_[below] + (place - double(below))*(parts_[below + 1] - parts_[below]);
}

double WedgeLevel::operator()(double height, double theta) const
{
    constexpr int directions = 48;
    const double h = std::max(0.0, height)/support_, steepness = std::clamp(theta, 20.0, 160.0);
    // Around the place, of the 180 degrees to the liquid's side as many as theta go upwards, and on for ever. The others meet the wall.
    double sum = 0;
    for (int k = 0; k < directions; ++k) sum += diskPart(h/std::sin(radians((180 - steepness)*(k + 0.5)/directions)));
    return steepness/360 + radians(180 - steepness)/directions*sum;
}

}
