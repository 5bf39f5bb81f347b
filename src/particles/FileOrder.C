// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/FileOrder.H"

#include <algorithm>
#include <limits>

namespace shizuku
{

namespace
{

using Rank = std::uint64_t;

struct Ranked
{
    Rank rank;
    std::uint32_t index;
};

bool before(const Ranked& a, const Ranked& b) { return a.rank < b.rank; }

std::vector<Ranked> ranked(const std::vector<Rank>& ranks)
{
    std::vector<Ranked> list(ranks.size());
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = {ranks[i], std::uint32_t(i)};
    std::sort(list.begin(), list.end(), before);
    return list;
}

std::size_t below(const std::vector<Rank>& sorted, Rank rank) { return std::lower_bound(sorted.begin(), sorted.end(), rank) - sorted.begin(); }

// For each list that every part gives, of equal length, the sums over the parts.
std::vector<std::size_t> sums(const Communicator& parts, const std::vector<std::size_t>& own)
{
    std::vector<std::size_t> all(own.size() * parts.parts()), result(own.size(), 0);
    parts.gather(own.data(), own.size() * sizeof(std::size_t), all.data());
    for (std::size_t k = 0; k < all.size(); ++k) result[k % own.size()] += all[k];
    return result;
}

// The ranks that the ranges behind the first begin with, by bisection: the least below which there are as many particles as there are in the ranges before.
std::vector<Rank> beginnings(const Communicator& parts, const std::vector<Rank>& sorted, const std::vector<std::size_t>& wanted)
{
    std::vector<Rank> low(wanted.size(), 0), high(wanted.size(), std::numeric_limits<Rank>::max());
    for (int bit = 0; bit < std::numeric_limits<Rank>::digits && !wanted.empty(); ++bit)
    {
        const auto middle = [&](std::size_t k) { return low[k] + (high[k] - low[k]) / 2; };
        std::vector<std::size_t> counts;
        for (std::size_t k = 0; k < wanted.size(); ++k) counts.push_back(below(sorted, middle(k)));
        counts = sums(parts, counts);
        for (std::size_t k = 0; k < wanted.size(); ++k)
        {
            if (counts[k] >= wanted[k]) high[k] = middle(k);
            else if (low[k] < high[k]) low[k] = middle(k) + 1;
        }
    }
    return high;
}

}

FileOrder::FileOrder(const Communicator& parts, const Buffer<std::uint32_t>& keys, const Buffer<std::uint32_t>& ids, int owned)
:
    parts_(parts), given_(owned)
{
    std::vector<Rank> ranks(owned);
    {
        std::vector<std::uint32_t> key(owned), id(owned);
        keys.download(key.data(), owned);
        ids.download(id.data(), owned);
        for (int i = 0; i < owned; ++i) ranks[i] = Rank(key[i]) << 32 | id[i];
        const std::vector<Ranked> list = ranked(ranks);
        for (int i = 0; i < owned; ++i) ranks[i] = list[i].rank, given_[i] = list[i].index;
    }
    all_ = sums(parts, {ranks.size()}).front();

    std::vector<std::size_t> wanted;
    for (int k = 1; k < parts.parts(); ++k) wanted.push_back(std::size_t(k) * (all_ / parts.parts()) + std::min(std::size_t(k), all_ % parts.parts()));
    ends_.push_back(0);
    for (const Rank begin : beginnings(parts, ranks, wanted)) ends_.push_back(below(ranks, begin));
    ends_.push_back(ranks.size());
    first_ = sums(parts, ends_)[parts.part()];

    std::vector<std::size_t> ofAll(ends_.size() * parts.parts());
    parts.gather(ends_.data(), ends_.size() * sizeof(std::size_t), ofAll.data());
    came_.push_back(0);
    for (int from = 0; from < parts.parts(); ++from)
    {
        const std::size_t* const ends = &ofAll[ends_.size() * from];
        came_.push_back(came_.back() + ends[parts.part() + 1] - ends[parts.part()]);
    }
    for (const Ranked& each : ranked(exchange(ranks))) order_.push_back(each.index);
}

}
