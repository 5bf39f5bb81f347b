// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/LineState.H"

#include "core/angles/Degrees.H"
#include "meshes/NearestPoint.H"

namespace shizuku
{

namespace
{

// Of an angle between limits, all in degrees: 1 of a line that advances, -1 of one that recedes, 0 of one that is held.
int directionOf(double angle, const ContactAngleLaw::Limits& limits)
{
    constexpr double noise = 1, apart = 4;
    const double inside = limits.second - limits.first > apart ? noise : -noise;
    return angle >= limits.second - inside ? 1 : angle <= limits.first + inside ? -1 : 0;
}

}

HeldAngles HeldAngles::of(const std::vector<Vector3>& positions, const std::vector<double>& radians)
{
    HeldAngles held;
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
        if (radians[i] == 0) continue;
        held.positions.push_back(positions[i]);
        held.angles.push_back(degrees(radians[i]));
    }
    return held;
}

void LineLaw::read()
{
    const auto file = case_/"constant/wettability";
    law_ = std::filesystem::exists(file) ? readLaw(Dictionary::read(file).subDictOrEmpty(wall_), case_) : nullptr;
}

LineState LineLaw::stateOf(const std::vector<LineTangent>& line, const HeldAngles& held, double spacing) const
{
    constexpr double reach = 2;             // spacings
    const LineScales any{spacing, 1e-3, 0.07};      // limits of a line at rest do not depend on them
    LineState state;
    if (!law_ || held.positions.empty()) return state;
    const NearestPoint nearest(held.positions);
    double known = 0, angles = 0, advancing = 0, receding = 0;
    for (const LineTangent& tangent : line)
    {
        const auto particle = nearest.within(tangent.point, reach*spacing);
        if (!particle) continue;
        const double angle = held.angles[*particle];
        const int direction = directionOf(angle, law_->limits(law_->at(tangent.point), 0, any));
        known += tangent.length;
        angles += tangent.length*angle;
        if (direction > 0) advancing += tangent.length;
        if (direction < 0) receding += tangent.length;
    }
    if (known == 0) return state;
    return {angles/known, (known - advancing - receding)/known, advancing/known, receding/known};
}

}
