// SPDX-License-Identifier: GPL-3.0-or-later
#include "sources/Sources.H"

#include "device/Algorithms.H"
#include "device/ForEach.H"
#include "device/Reduce.H"
#include "parallel/AllParts.H"
#include "sources/Occupied.H"

#include <algorithm>
#include <sstream>
#include <tuple>

namespace shizuku
{

namespace
{

Dictionary readSources(const std::filesystem::path& casePath)
{
    const auto file = casePath / "constant/sources";
    return std::filesystem::exists(file) ? Dictionary::read(file) : Dictionary();
}

// A particle that may be drawn, and how far ahead it is of those that go first.
struct Ahead
{
    double along;
    std::uint32_t id;
};

struct IsOutside
{
    Span<const std::uint32_t> gone;
    Span<const std::uint32_t> id;
    Span<std::uint8_t> is;

    HOST_DEVICE void operator()(int i) const
    {
        bool stays = true;
        for (int k = 0; k < gone.size; ++k) stays = stays && id[i] != gone[k];
        is[i] = stays;
    }
};

}

Sources::Sources(const std::filesystem::path& casePath, Liquid& liquid) : space_(liquid)
{
    const Dictionary dict = readSources(casePath);
    for (const std::string& name : dict.dictKeys())
    {
        const Dictionary entry = dict.subDict(name);
        const SourceSetting setting{name, liquid};
        const SourceLocation where = entry.where("type");
        list_.push_back({name, where, SourceTable::New("source", entry.lookup<std::string>("type"), where, entry, setting), &liquid.number(numberOf(name), 0)});
        const Source& source = *list_.back().source;
        const double room = source.stream(0) ? setting.spacing() / 2 : 0;
        space_.refuseOutside(name, where, source.places(), room);
    }
    dict.refuseUnused();
}

std::vector<std::string> Sources::names(const std::filesystem::path& casePath)
{
    return readSources(casePath).dictKeys();
}

bool Sources::mayChange(const std::string& entry)
{
    const std::size_t from = entry.find('.');
    if (from == std::string::npos) return false;
    const std::string word = entry.substr(from + 1, entry.find('.', from + 1) - from - 1);
    return word == "flowRate" || word == "velocity" || word == "rate" || word == "speed" || word == "level";
}

void Sources::refuseLongSteps(double deltaT) const
{
    for (const Named& named : list_)
    {
        if (deltaT <= named.source->longestStep()) continue;
        std::ostringstream found, expected;
        found << "In a step of " << deltaT << " s the source '" << named.name << "' would move its liquid too far";
        expected << "a deltaT of at most " << named.source->longestStep() << " s in system/controlDict";
        throw FatalInputError(named.where, found.str(), expected.str());
    }
}

void Sources::beginStep(const Liquid& liquid, double time, double deltaT)
{
    if (list_.empty()) return;
    refuseLongSteps(deltaT);
    std::vector<Stream> streams;
    bool bear = false;
    for (const Named& named : list_)
    {
        const auto stream = named.source->stream(time + deltaT / 2);
        if (!stream) continue;
        bear = bear || named.source->bearsLiquid();
        for (const Stream& each : space_.withImages(*stream)) streams.push_back(each.scaled(liquid.units().length, liquid.units().of(dimensions::velocity)));
    }
    held_.set(streams, bear);
}

Sources::Change Sources::apply(Liquid& liquid, double from, double to, double& nextNumber, std::size_t memoryBytes)
{
    Change change;
    if (list_.empty()) return change;
    const auto areOccupied = [&](const std::vector<Vector3>& places, double reach) { return shizuku::areOccupied(liquid, space_, places, reach); };
    const auto distance = [&](const Vector3& a, const Vector3& b) { return length(space_.periods().shortest(a - b)); };
    const auto countIn = [&](const Pool& pool) { return particlesIn(liquid, pool, space_.periods()); };
    const auto heightOver = [&](const Pool& pool, const Vector3& column, double apart) { return restingHeight(liquid, pool, space_.periods(), column, apart); };
    std::vector<Birth> births;
    for (const Named& named : list_)
    {
        const std::size_t before = births.size();
        named.source->bear({from, to, areOccupied, distance, countIn, heightOver}, births);
        *named.entered += double(births.size() - before);
    }
    change.entered = int(births.size());
    if (liquid.parts().part() == 0) bear(liquid, births, nextNumber);
    nextNumber += double(births.size());
    for (const Named& named : list_)
    {
        const int due = named.source->due();
        if (due == 0) continue;
        const auto pool = named.source->drawsFrom();
        const int drawn = pool ? draw(liquid, highestOf(*pool, liquid), due) : draw(liquid, farthestBackIn(*named.source->stream(to), liquid), due);
        named.source->drew(drawn);
        *named.entered -= drawn;
        change.drawn += drawn;
    }
    // Where memory grows next, it grows by a quarter.
    const DeviceCounters& counters = deviceCounters();
    const double next = liquid.owned() == 0 ? 0 : double(counters.peakBytes) * 1.3 * liquid.owned() / std::max(liquid.fields().room(), 1);
    change.isFull = liquid.parts().any(memoryBytes > 0 && change.entered > 0 && next > double(memoryBytes));
    return change;
}

void Sources::bear(Liquid& liquid, const std::vector<Birth>& births, double firstNumber)
{
    if (births.empty()) return;
    const double unit = liquid.units().length, unitOfSpeed = liquid.units().of(dimensions::velocity);
    std::vector<Position> places;
    std::vector<Vec3> velocities;
    std::vector<std::uint32_t> numbers;
    for (const Birth& birth : births)
    {
        const Vector3 x = space_.between(birth.place) / unit, u = birth.velocity / unitOfSpeed;
        places.push_back(positionAt(x.x, x.y, x.z));
        velocities.push_back({scalar(u.x), scalar(u.y), scalar(u.z)});
        numbers.push_back(std::uint32_t(firstNumber + double(numbers.size())));
    }
    const int first = liquid.owned();
    liquid.resize(first);                       // without ghosts
    liquid.grow(first + int(births.size()));
    liquid.position.upload(places, first);
    liquid.predicted.upload(places, first);
    liquid.velocity.upload(velocities, first);
    liquid.id.upload(numbers, first);
}

Sources::Rank Sources::farthestBackIn(Stream wide, const Liquid& liquid) const
{
    wide.from -= wide.length*wide.axis;         // with what has moved back into the opening
    wide.length *= 2;
    std::vector<Stream> streams;
    for (const Stream& each : space_.withImages(wide)) streams.push_back(each.scaled(liquid.units().length, 1));
    return [streams](Place p) -> std::optional<double>
    {
        const auto in = std::find_if(streams.begin(), streams.end(), [&](const Stream& each) { return each.contains(p); });
        if (in == streams.end()) return std::nullopt;
        const Vector3 x(quanta::lengthOf(p.x), quanta::lengthOf(p.y), quanta::lengthOf(p.z));
        return dot(x - in->from, in->axis);
    };
}

Sources::Rank Sources::highestOf(const Pool& box, const Liquid& liquid) const
{
    const double unit = liquid.units().length;
    return [pool = box.scaled(unit), periods = space_.periods().scaled(unit)](Place p) { return pool.contains(p, periods) ? std::optional(-pool.heightOf(p, periods)) : std::nullopt; };
}

int Sources::draw(Liquid& liquid, const Rank& rankOf, int most)
{
    const std::vector<Position> positions = liquid.position.download();
    const std::vector<std::uint32_t> ids = liquid.id.download();
    std::vector<Ahead> own;
    for (int i = 0; i < liquid.owned(); ++i)
    {
        if (const auto rank = rankOf(placeOf(positions[i]))) own.push_back({*rank, ids[i]});
    }
    std::vector<Ahead> all = gatherLists(liquid.parts(), own);
    std::sort(all.begin(), all.end(), [](const Ahead& a, const Ahead& b) { return std::tie(a.along, a.id) < std::tie(b.along, b.id); });
    if (int(all.size()) > most) all.resize(most);
    std::vector<std::uint32_t> gone;
    for (const Ahead& ahead : all) gone.push_back(ahead.id);
    if (gone.empty()) return 0;
    const Buffer<std::uint32_t> lost(gone);
    Buffer<std::uint8_t> stays(liquid.owned());
    forEach(liquid.owned(), IsOutside{lost.span(), std::as_const(liquid.id).span(), stays.span()});
    liquid.resize(liquid.owned());
    Selection others;
    Readback count;
    select(stays, others, liquid.owned(), count);
    const int remaining = int(*count.wait());
    if (remaining == liquid.owned()) return int(gone.size());
    others.indices.resize(remaining);
    liquid.fields().reorder(others.indices);
    liquid.resize(remaining);
    return int(gone.size());
}

}
