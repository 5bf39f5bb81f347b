// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/Algorithms.H"
#include "device/Buffer.H"
#include "device/Device.H"
#include "device/ForEach.H"
#include "device/Gather.H"

#include <gtest/gtest.h>

using namespace shizuku;

namespace
{

struct AddIndex
{
    Span<int> values;

    HOST_DEVICE void operator()(int i) const { values[i] += i + 1; }
};

// Not what it would be in any other order.
struct TimesThreePlus
{
    std::uint32_t number;
    Span<std::uint32_t> values;

    HOST_DEVICE void operator()(int i) const { values[i] = 3 * values[i] + number; }
};

struct Sums
{
    scalar numbers, squares, least;
};

// Of 0, 1, ... i mod 40, and those among them that three divides, in their order.
struct TakeTurns
{
    Span<Sums> sums;
    Span<int> multiples;                // 14 an index

    HOST_DEVICE void operator()(int i, Team team) const
    {
        const int end = i % 40 + 1;
        Sums own{0, 0, 0};
        for (int k = team.lane; k < end; k += team.width) 
        {
            const scalar less = scalar(k % 11 - k);
            own = {own.numbers + scalar(k), own.squares + scalar(k * k), less < own.least ? less : own.least};
        }
        own = {team.sum(own.numbers), team.sum(own.squares), team.min(own.least)};
        if (team.first()) 
        {
            sums[i] = {sums[i].numbers + own.numbers, sums[i].squares + own.squares, sums[i].least + own.least};
        }

        int found = 0;
        for (int turn = 0; turn < 40; turn += team.width)          // as many turns whatever the index is (device/Team.H)
        {
            const int k = turn + team.lane;
            const bool takes = k < end && k % 3 == 0;
            const Team::Place place = team.place(takes);
            if (takes) multiples[14 * i + found + place.before] = k;
            found += place.all;
        }
    }
};

// Of each index: that it is visited, 780 times it, and which of 0, 5, 10, ... 55 is nearest to the group's first, of two the lower.
struct TakeTogether
{
    Span<int> visits;
    Span<scalar> sums, least, at;

    HOST_DEVICE void operator()(Group group, Team team) const
    {
        scalar values[Group::most] = {};
        for (int p = 0; p < Group::most; ++p)
        {
            for (int k = team.lane; k < 40; k += team.width) values[p] += scalar(k * group[p]);
        }
        Team::Least nearest{1e9f, 1e9f};
        for (int k = team.lane; k < 12; k += team.width)
        {
            const scalar distance = fabs(scalar(5 * k - group.first % 60));
            if (distance < nearest.value) nearest = {distance, scalar(k)};
        }
        const scalar sum = team.sums(values);
        nearest = team.least(nearest);
        const bool any = team.any(team.lane == group.first % team.width), none = team.any(team.lane < 0);
        if (team.lane >= group.size) return;
        const int i = group.first + team.lane;
        visits[i] += any && !none ? 1 : 100;
        sums[i] = sum;
        least[i] = nearest.value;
        at[i] = nearest.at;
    }
};

struct TurnsTaken
{
    explicit TurnsTaken(int n) : sums(n + 1), multiples(14 * (n + 1))
    {
        sums.setZero();
        multiples.setZero();
    }

    TakeTurns functor() { return {sums.span(), multiples.span()}; }

    Buffer<Sums> sums;
    Buffer<int> multiples;
};

// Whole numbers below 2^24: exact in any order.
void expectTurns(const TurnsTaken& turns, int i, bool visited)
{
    const Sums sum = turns.sums.download()[i];
    const std::vector<int> multiples = turns.multiples.download();
    const int last = visited ? i % 40 : 0;
    ASSERT_EQ(sum.numbers, scalar(last * (last + 1) / 2)) << i;
    ASSERT_EQ(sum.squares, scalar(last * (last + 1) * (2 * last + 1) / 6)) << i;
    ASSERT_EQ(sum.least, scalar(-(last / 11 * 11))) << i;
    for (int k = 0; k < 14; ++k) ASSERT_EQ(multiples[14 * i + k], 3 * k <= last ? 3 * k : 0) << i;
}

}

// Sizes around the blocks that backends launch, and one beyond the last index that must stay as it was.
TEST(ForEach, VisitsEachIndexOnce)
{
    for (const int n : {1, 2, 127, 128, 129, 4096, 100003})
    {
        Buffer<int> buffer(n + 1);
        buffer.setZero();
        forEach(n, AddIndex{buffer.span()});
        const std::vector<int> values = buffer.download();
        for (int i = 0; i < n; ++i) ASSERT_EQ(values[i], i + 1) << "of " << n;
        EXPECT_EQ(values[n], 0) << "of " << n;
    }
}

TEST(ForEach, CountsLaunchesAndMakesNoneOfNothing)
{
    Buffer<int> buffer(8);
    buffer.setZero();
    const long before = deviceCounters().launches;
    forEach(0, AddIndex{buffer.span()});
    forEach(-3, AddIndex{buffer.span()});
    EXPECT_EQ(deviceCounters().launches, before);
    forEach(8, AddIndex{buffer.span()});
    forEach(1, AddIndex{buffer.span()});
    EXPECT_EQ(deviceCounters().launches, before + 2);
    synchronize();
}

// Numbers of indices for which a GPU takes teams of 32, 16, eight, two and of one.
TEST(ForEachTeam, SharesWhatAnIndexHasToVisit)
{
    for (const int n : {1, 3, 1000, 6001, 20001, 200001, 600001})
    {
        TurnsTaken turns(n);
        forEachTeam(n, turns.functor());
        for (const int i : {0, n / 3, n / 2, n - 1}) expectTurns(turns, i, true);
        expectTurns(turns, n, false);
    }
}

TEST(ForEach, VisitsSelectedIndicesOnce)
{
    for (const int n : {0, 1, 2, 5000, 300001})
    {
        std::vector<std::uint8_t> chosen(n);
        for (int i = 0; i < n; ++i) chosen[i] = i % 7 == 1 || i % 100 > 90;
        Selection selection;
        select(Buffer<std::uint8_t>(chosen), selection);
        TurnsTaken turns(n);
        forEachTeam(selection, turns.functor());
        Buffer<int> visits(n + 1);
        visits.setZero();
        forEach(selection, AddIndex{visits.span()});
        const std::vector<int> visited = visits.download();
        for (int i = 0; i < n; ++i) ASSERT_EQ(visited[i], chosen[i] ? i + 1 : 0) << "of " << n;
        if (n == 0) continue;
        for (const int i : {0, n / 7, n / 3, n / 2, n - 1}) expectTurns(turns, i, chosen[i]);
        const auto sums = turns.sums.download();
        double all = 0, expected = 0;
        for (int i = 0; i < n; ++i)
        {
            all += sums[i].numbers;
            expected += chosen[i] ? i % 40 * (i % 40 + 1) / 2 : 0;
        }
        EXPECT_EQ(all, expected) << "of " << n;
    }
}

// Sizes around those of groups.
TEST(ForEachGroup, VisitsEachIndexOnce)
{
    for (const int n : {1, 3, 4, 5, 1000, 300001})
    {
        Buffer<int> visits(n + 1);
        Buffer<scalar> sums(n + 1), least(n + 1), at(n + 1);
        visits.setZero();
        for (Buffer<scalar>* each : {&sums, &least, &at}) each->setZero(n);
        forEachGroup(n, TakeTogether{visits.span(), sums.span(), least.span(), at.span()});
        const auto visited = visits.download();
        const auto sum = sums.download(), nearest = least.download(), where = at.download();
        EXPECT_EQ(visited[n], 0) << "of " << n;
        for (int i = 0; i < n; ++i)
        {
            ASSERT_EQ(visited[i], 1) << i << " of " << n;
            const int first = i / Group::most * Group::most % 60, below = std::min(first / 5, 11);
            const int k = below < 11 && 5 * (below + 1) - first < first - 5 * below ? below + 1 : below;
            ASSERT_EQ(nearest[i], scalar(std::abs(5 * k - first))) << i << " of " << n;
            ASSERT_EQ(where[i], scalar(k)) << i << " of " << n;
            if (i < 20000)                                  // below 2^24: exact in any order
            {
                ASSERT_EQ(sum[i], scalar(780 * i)) << i << " of " << n;
            }
        }
    }
}

// As many groups as there are of those selected, which give their places.
TEST(ForEachGroup, VisitsEachPlaceOfASelectionOnce)
{
    for (const int n : {0, 7, 5000, 300001})
    {
        std::vector<std::uint8_t> chosen(n);
        for (int i = 0; i < n; ++i) chosen[i] = i % 3 == 1;
        const int all = n / 3 + (n % 3 == 2);
        Selection selection;
        select(Buffer<std::uint8_t>(chosen), selection);
        Buffer<int> visits(n + 1);
        Buffer<scalar> sums(n + 1), least(n + 1), at(n + 1);
        visits.setZero();
        forEachGroup(selection, TakeTogether{visits.span(), sums.span(), least.span(), at.span()});
        const auto visited = visits.download();
        for (int k = 0; k <= n; ++k) ASSERT_EQ(visited[k], k < all ? 1 : 0) << k << " of " << n;
    }
}

TEST(Gather, TakesElementsInTheGivenOrder)
{
    const Buffer<scalar> from(std::vector<scalar>{10, 11, 12, 13});
    const Buffer<std::uint32_t> order(std::vector<std::uint32_t>{3, 0, 0, 2, 1});
    Buffer<scalar> to;
    gather(from, order, to);
    EXPECT_EQ(to.download(), (std::vector<scalar>{13, 10, 10, 12, 11}));
}

// More loops than go to a GPU at once, with other arguments each time, and with waits in between.
TEST(ForEach, LoopsFollowEachOther)
{
    constexpr int n = 700;
    Buffer<std::uint32_t> values(n);
    values.setZero();
    std::uint32_t expected = 0;
    for (const int loops : {1, 3, 100, 5, 100})
    {
        for (int k = 0; k < loops; ++k)
        {
            forEach(n, TimesThreePlus{std::uint32_t(k), values.span()});
            expected = 3 * expected + std::uint32_t(k);
        }
        EXPECT_EQ(values.download(), std::vector<std::uint32_t>(n, expected));
    }
}
