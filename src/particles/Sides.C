// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Sides.H"

#include <algorithm>
#include <sstream>

namespace shizuku
{

Sides::Sides(const BoxSides& box, double unit) : box_(box), unit_(unit)
{
    constexpr std::int64_t longest = std::int64_t(1) << (quanta::single ? 31 : 51);
    for (int k = 0; k < 3; ++k)
    {
        for (const bool upper : {false, true})
        {
            maps_.isOpen[k][upper] = box.kind[k][upper] == Kind::open;
            maps_.at[k][upper] = quanta::wholeOf(box.at[k][upper] / unit);
            maps_.map[k][upper ? AtSides::upper : AtSides::lower] = {-1, 2 * maps_.at[k][upper]};
        }
        if (!box.isCyclic(k)) continue;
        const std::int64_t period = maps_.at[k][1] - maps_.at[k][0];
        maps_.map[k][AtSides::lower] = {1, period};
        maps_.map[k][AtSides::upper] = {1, -period};
        if (period < longest) continue;
        std::ostringstream found, expected;
        found << "The cyclic sides " << BoxSides::name(k, false) << " and " << BoxSides::name(k, true) << " are " << box.at[k][1] - box.at[k][0] << " m apart";
        expected << "less than " << unit * quanta::lengthOf(longest) << " m, so that neighbours are told from their images; or open sides";
        throw FatalInputError(box.where[k][0], found.str(), expected.str());
    }
}

std::optional<Sides> Sides::read(const std::filesystem::path& casePath, double unit)
{
    const std::optional<BoxSides> box = BoxSides::read(casePath);
    return box ? std::optional(Sides(*box, unit)) : std::nullopt;
}

void Sides::refuseNarrow(scalar reach) const
{
    for (int k = 0; k < 3; ++k)
    {
        if (maps_.isOpen[k][0] || maps_.isOpen[k][1]) continue;
        const double apart = quanta::lengthOf(maps_.at[k][1] - maps_.at[k][0]);
        if (apart >= 2 * double(reach)) continue;
        std::ostringstream found, expected;
        found << "The sides " << BoxSides::name(k, false) << " and " << BoxSides::name(k, true) << " are " << apart * unit_ << " m apart, and particles see each other across "
              << reach * unit_ << " m, so that they would see some twice";
        expected << "at least " << 2 * double(reach) * unit_ << " m";
        throw FatalInputError(box_.where[k][0], found.str(), expected.str());
    }
}

void Sides::refuseOutside(const std::vector<Vector3>& places) const
{
    for (int k = 0; k < 3; ++k)
    {
        const double period = box_.isCyclic(k) ? box_.at[k][1] - box_.at[k][0] : 0;
        for (const bool upper : {false, true})
        {
            if (maps_.isOpen[k][upper]) continue;
            const double at = box_.at[k][upper];
            const auto isOutside = [&](const Vector3& x) { return upper ? !(x[k] < at + period) : !(x[k] >= at - period); };
            const auto outside = std::find_if(places.begin(), places.end(), isOutside);
            if (outside == places.end()) continue;
            std::ostringstream found, expected;
            found << "A liquid particle at " << str(*outside) << " m is beyond the side " << BoxSides::name(k, upper) << ", at " << "xyz"[k] << " = " << at << " m";
            expected << "liquid " << (upper ? "below" : "above") << " it";
            if (period > 0) expected << "; what is less than a period, " << period << " m, beyond it comes in at the other side";
            throw FatalInputError(box_.where[k][upper], found.str(), expected.str());
        }
    }
}

std::string Sides::description() const
{
    std::ostringstream text;
    const auto separate = [&] { return text.tellp() > 0 ? ", " : ""; };
    for (int k = 0; k < 3; ++k)
    {
        if (box_.isCyclic(k)) text << separate() << "xyz"[k] << " cyclic over " << box_.at[k][1] - box_.at[k][0] << " m";
        for (const bool upper : {false, true})
        {
            if (box_.kind[k][upper] == Kind::symmetryPlane) text << separate() << BoxSides::name(k, upper) << " symmetryPlane";
        }
    }
    return text.str();
}

}
