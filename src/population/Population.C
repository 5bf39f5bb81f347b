// SPDX-License-Identifier: GPL-3.0-or-later
#include "population/Population.H"

#include "device/Reduce.H"

#include <sstream>

namespace shizuku
{

namespace
{

constexpr double unknown = -1;

struct Highest
{
    double value = -1;
    HOST_DEVICE void add(const Highest& other) { value = other.value > value ? other.value : value; }
};

struct NumberOf
{
    Span<const std::uint32_t> id;
    HOST_DEVICE Highest operator()(int i) const { return {double(id[i])}; }
};

}

Population::Population(const std::filesystem::path& casePath, Liquid& liquid)
:
    outlets_(casePath, liquid), sources_(casePath, liquid)
{
    if (sources_.empty()) return;
    filled_ = &liquid.number(filledNumber, unknown);
    next_ = &liquid.number("nextNumber", unknown);
    refuseInOutlets(liquid);
}

void Population::refuseInOutlets(const Liquid& liquid) const
{
    for (const Sources::Named& named : sources_.list())
    {
        for (const Vector3& place : named.source->places())
        {
            const Vector3 x = sources_.space().between(place) / liquid.units().length;
            const std::string outlet = outlets_.at(placeAt(x.x, x.y, x.z));
            if (outlet.empty()) continue;
            throw FatalInputError(named.where, "Liquid of the source '" + named.name + "' comes in at " + str(place) + " m, where the outlet '" + outlet + "' takes it out", "sources that lie outside of all outlets, and within the bounds that these make");
        }
    }
}

void Population::refuseInWalls(const Walls& walls, Liquid& empty) const
{
    for (const Sources::Named& named : sources_.list())
    {
        std::vector<Position> places;
        for (const Vector3& place : named.source->places())
        {
            const Vector3 x = sources_.space().between(place) / empty.units().length;
            places.push_back(positionAt(x.x, x.y, x.z));
        }
        empty.resize(int(places.size()));
        empty.position.upload(places);
        const std::string wall = walls.solidAround(empty);
        if (!wall.empty()) throw FatalInputError(named.where, "Liquid of the source '" + named.name + "' comes in inside of the solid '" + wall + "', or too near to it", "a source half a spacing outside of every wall, with two supports of room behind the mouth of a nozzle");
    }
}

void Population::begin(const Liquid& liquid)
{
    if (sources_.empty()) return;
    if (*filled_ == unknown) *filled_ = liquid.parts().count(liquid.owned());
    if (*next_ != unknown) return;
    Buffer<Highest> scratch;
    *next_ = liquid.parts().fold(reduce(liquid.owned(), NumberOf{liquid.id.span()}, scratch)).value + 1;
}

Population::Change Population::endStep(Liquid& liquid, double from, double to, std::size_t memoryBytes)
{
    Change change;
    change.any = outlets_.takeOut(liquid) > 0;
    if (sources_.empty()) return change;
    const Sources::Change sources = sources_.apply(liquid, from, to, *next_, memoryBytes);
    change.any = change.any || sources.entered > 0 || sources.drawn > 0;
    change.isFull = sources.isFull;
    constexpr double most = 4294967295.0;       // a particle's number has 32 bits
    if (*next_ > most) throw FatalError("Sources have let in more particles than there are numbers for, 2^32.");
    return change;
}

std::string Population::report(const std::map<std::string, double>& numbers, double particleVolume, int particles) const
{
    std::ostringstream text;
    if (!outlets_.names().empty()) text << "taken out: " << outlets_.report(numbers, particleVolume) << '\n';
    if (sources_.empty()) return text.str();
    double entered = 0, left = 0;
    text << "entered: ";
    for (const Sources::Named& named : sources_.list())
    {
        const double number = *named.entered;
        entered += number;
        text << (&named == sources_.list().data() ? "" : "; ") << named.name << ' ' << long(number) << " particles, " << number * particleVolume << " m3 of " << named.source->asked() << " m3 asked for";
    }
    for (const std::string& name : outlets_.names()) left += numbers.at(Outlets::numberOf(name));
    text << "\nbalance: " << long(*filled_) << " filled + " << long(entered) << " entered - " << long(left) << " left = " << long(*filled_ + entered - left)
         << ", there are " << particles << " particles\n";
    return text.str();
}

}
