// SPDX-License-Identifier: GPL-3.0-or-later
#include "outlets/Outlets.H"

#include "device/Algorithms.H"
#include "device/ForEach.H"
#include "device/Reduce.H"
#include "outlets/Outlet.H"

#include <sstream>

namespace shizuku
{

namespace
{

Dictionary readOutlets(const std::filesystem::path& casePath)
{
    const auto file = casePath / "constant/outlets";
    return std::filesystem::exists(file) ? Dictionary::read(file) : Dictionary();
}

// The first outlet that a place is in; as many as there are: none.
HOST_DEVICE inline int outletOf(Span<const OutletRegion> regions, Position position)
{
    const Place x = placeOf(position);
    int k = 0;
    while (k < regions.size && !regions[k].contains(x)) ++k;
    return k;
}

struct CountInOutlets
{
    struct Sum
    {
        int number[Outlets::most] = {};

        HOST_DEVICE void add(const Sum& other)
        {
            for (int k = 0; k < Outlets::most; ++k) number[k] += other.number[k];
        }
    };

    Span<const OutletRegion> regions;
    Span<const Position> position;

    HOST_DEVICE Sum operator()(int i) const
    {
        Sum sum;
        const int outlet = outletOf(regions, position[i]);
        for (int k = 0; k < Outlets::most; ++k) sum.number[k] = k == outlet && k < regions.size;
        return sum;
    }
};

struct IsInNone
{
    Span<const OutletRegion> regions;
    Span<const Position> position;
    Span<std::uint8_t> is;

    HOST_DEVICE void operator()(int i) const { is[i] = outletOf(regions, position[i]) == regions.size; }
};

int total(const CountInOutlets::Sum& sum)
{
    int all = 0;
    for (const int number : sum.number) all += number;
    return all;
}

}

Outlets::Outlets(const std::filesystem::path& casePath, Liquid& liquid)
{
    const Dictionary dict = readOutlets(casePath);
    for (const std::string& name : dict.dictKeys())
    {
        const Dictionary outlet = dict.subDict(name);
        const auto shape = OutletTable::New("outlet", outlet.lookup<std::string>("type"), outlet.where("type"), outlet);
        list_.push_back(shape->region().scaled(liquid.units().length));
        names_.push_back(name);
        numbers_.push_back(&liquid.number(numberOf(name), 0));
    }
    dict.refuseUnused();
    if (names_.size() > most)
    {
        throw FatalInputError(dict.where(), "There are " + std::to_string(names_.size()) + " outlets", std::to_string(most) + " at most");
    }
    if (!list_.empty()) regions_.upload(list_);
}

std::vector<std::string> Outlets::names(const std::filesystem::path& casePath)
{
    return readOutlets(casePath).dictKeys();
}

int Outlets::takeOut(Liquid& liquid)
{
    if (names_.empty()) return 0;
    Buffer<CountInOutlets::Sum> scratch;
    const auto own = reduce(liquid.owned(), CountInOutlets{regions_.span(), liquid.position.span()}, scratch);
    if (const int leaving = total(own); leaving > 0) keepOthers(liquid, liquid.owned() - leaving);
    const auto all = liquid.parts().fold(own);
    for (std::size_t k = 0; k < names_.size(); ++k) *numbers_[k] += all.number[k];
    return total(all);
}

void Outlets::keepOthers(Liquid& liquid, int remaining)
{
    Buffer<std::uint8_t> stays(liquid.owned());
    forEach(liquid.owned(), IsInNone{regions_.span(), liquid.position.span(), stays.span()});
    Selection others;
    select(stays, others);
    others.indices.resize(remaining);
    liquid.fields().reorder(others.indices);
    liquid.resize(remaining);
}

std::string Outlets::at(Place place) const
{
    for (std::size_t k = 0; k < list_.size(); ++k)
    {
        if (list_[k].contains(place)) return names_[k];
    }
    return {};
}

std::string Outlets::report(const std::map<std::string, double>& numbers, double particleVolume) const
{
    std::ostringstream text;
    for (std::size_t k = 0; k < names_.size(); ++k)
    {
        const double number = numbers.at(numberOf(names_[k]));
        text << (k > 0 ? "; " : "") << names_[k] << ' ' << long(number) << " particles, " << number * particleVolume << " m3";
    }
    return text.str();
}

}
