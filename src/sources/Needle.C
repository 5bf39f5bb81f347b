// SPDX-License-Identifier: GPL-3.0-or-later
// needle { type needle; mouth (0 0 0); direction (0 0 1); radius 0.3e-3; flowRate 2e-9; }      // negative: draws
//
// An opening in a wall, below liquid or not. Two spacings of liquid in front of it move with the flow (sources/Stream.H). Particles are born at the wall one by
// one, in columns that take turns, as often as the flow has brought the volume of one; or those nearest to the wall are drawn.

#include "sources/Opening.H"
#include "sources/Source.H"
#include "sources/TimedValue.H"
#include "sources/Turns.H"

#include <cmath>
#include <limits>

namespace shizuku
{

namespace
{

class Needle : public Source
{
public:
    Needle(const Dictionary& dict, const SourceSetting& setting)
    :
        opening_(dict, setting.spacing(), false),
        rate_(dict, "flowRate", Dimensions{{0, 3, -1, 0, 0, 0, 0}}, -std::numeric_limits<double>::infinity()),
        volume_(setting.number("Volume", 0)), let_(setting.number("Let", 0)), turns_(setting.number("Turns", 0))
    {}

    std::vector<Vector3> places() const override
    {
        std::vector<Vector3> places;
        for (const Vector3& column : opening_.columns) places.push_back(at(column));
        return places;
    }

    std::optional<Stream> stream(double time) const override
    {
        constexpr double deep = 2, aside = 0.3;
        return Stream{opening_.mouth, opening_.direction, deep*opening_.spacing, 0, opening_.radius + aside*opening_.spacing, speed(time)};
    }

    double longestStep() const override
    {
        const double most = rate_.most()/opening_.area();
        return most > 0 ? opening_.spacing/most : std::numeric_limits<double>::infinity();
    }

    void bear(const SourceStep& step, std::vector<Birth>& births) override
    {
        constexpr double free = 0.5;            // spacings
        volume_ += rate_.at(step.middle())*step.length();
        const std::size_t first = births.size(), n = opening_.columns.size();
        for (std::size_t tried = 0; let_ < wanted() && tried < n; ++tried, ++turns_)
        {
            const Vector3 place = at(opening_.columns[columnOfTurn(turns_, n)]);
            bool isFree = !step.isOccupied(place, free*opening_.spacing);
            for (std::size_t k = first; k < births.size(); ++k) isFree = isFree && step.distance(births[k].place, place) > free*opening_.spacing;
            if (!isFree) continue;
            births.push_back({place, speed(step.middle())*opening_.direction});
            ++let_;
        }
    }

    int due() const override { return let_ > wanted() ? int(let_ - wanted()) : 0; }
    void drew(int taken) override { let_ -= taken; }

    double asked() const override { return volume_; }

private:
    double wanted() const { return std::floor(volume_/(opening_.spacing*opening_.spacing*opening_.spacing) + 1e-6); }
    double speed(double time) const { return rate_.at(time)/opening_.area(); }
    Vector3 at(const Vector3& column) const { return opening_.mouth + column + opening_.spacing/2*opening_.direction; }

    Opening opening_;
    TimedValue rate_;
    double &volume_, &let_, &turns_;            // m3 asked for; particles let in, less those drawn; columns that had their turn
};

const SourceTable::Add<Needle> registered{"needle", "feeds liquid through a wall, or draws it"};

}

}
