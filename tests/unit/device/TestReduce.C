// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/ForEach.H"
#include "device/Reduce.H"
#include "support/PointSets.H"
#include "support/Threads.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

struct LongSum
{
    long value = 0;
    HOST_DEVICE void add(const LongSum& other) { value += other.value; }
};

struct Squares
{
    HOST_DEVICE LongSum operator()(int i) const { return {long(i) * i}; }
};

struct ScalarSum
{
    scalar value = 0;
    HOST_DEVICE void add(const ScalarSum& other) { value += other.value; }
};

struct ReadScalar
{
    Span<const scalar> values;
    HOST_DEVICE ScalarSum operator()(int i) const { return {values[i]}; }
};

struct WidthOfTeam
{
    Span<std::uint32_t> width;
    HOST_DEVICE void operator()(int i, Team team) const { if (team.first()) width[i] = std::uint32_t(team.width); }
};

// Lanes of a team, where so many sums are formed.
int widthOf(int sums)
{
    Buffer<std::uint32_t> width(sums);
    forEachTeam(sums, WidthOfTeam{width.span()});
    return int(width.download()[0]);
}

// The order that device/Reduce.H fixes, one addition after the other.
std::vector<scalar> fold(const std::vector<scalar>& values, int sums)
{
    const int n = int(values.size()), width = widthOf(sums), share = (n + sums * width - 1) / (sums * width);
    std::vector<scalar> result;
    for (int c = 0; c < sums; ++c)
    {
        std::vector<scalar> lane(width, 0);
        for (int l = 0; l < width; ++l)
        {
            for (int k = 0; k < share; ++k)
            {
                const int i = device::interleave > 1 ? (c + k * sums) * width + l : c * share + k;
                if (i < n) lane[l] += values[i];
            }
        }
        for (int half = width / 2; half > 0; half /= 2)
        {
            for (int l = 0; l < half; ++l) lane[l] += lane[l + half];
        }
        result.push_back(lane[0]);
    }
    return result;
}

}

// Integers do not round: the sum is exact, whatever the number of sums leaves over.
TEST(Reduce, SumsIntegersExactly)
{
    Buffer<LongSum> scratch;
    for (const long n : {0L, 1L, 255L, 256L, 8191L, 8192L, 8193L, 100003L})
    {
        EXPECT_EQ(reduce(int(n), Squares{}, scratch).value, (n - 1) * n * (2 * n - 1) / 6) << "n = " << n;
    }
}

// Scalars of very different size, whose sum depends on the order of additions: same bits on any number of threads. By one pass,
// and by two.
TEST(Reduce, GivesTheSameBitsOnAnyNumberOfThreads)
{
    RandomNumbers random(7);
    for (const auto& [n, sums] : {std::pair{20011, device::fewSums}, std::pair{200011, 24 * device::fewSums}})
    {
        std::vector<scalar> values(n);
        for (scalar& v : values) v = std::exp(random(-12, 12)) * (random(0, 1) < 0.5f ? -1.0f : 1.0f);
        EXPECT_EQ(device::sumsFor(n), sums);
        std::vector<scalar> few = fold(values, sums);
        if (sums > device::fewSums) few = fold(few, device::fewSums);
        scalar expected = 0;
        for (const scalar part : few) expected += part;

        const Buffer<scalar> buffer(values);
        Buffer<ScalarSum> scratch, sum;
        for (const int threads : {1, 2, 3, 7})
        {
            const UseThreads use(threads);
            EXPECT_EQ(reduce(n, ReadScalar{buffer.span()}, scratch).value, expected) << threads << " threads";
            reduce(n, ReadScalar{buffer.span()}, scratch, sum);
            EXPECT_EQ(sum.download().at(0).value, fold(few, 1).at(0)) << threads << " threads";
        }
    }
}

TEST(Reduce, KeepsItsScratchMemory)
{
    Buffer<LongSum> scratch;
    reduce(1000000, Squares{}, scratch);
    const std::size_t bytes = deviceCounters().bytes;
    reduce(1000, Squares{}, scratch);
    EXPECT_EQ(deviceCounters().bytes, bytes);
}

// Of one pass and of two; what the device is given meanwhile, reductions of the same type among it, takes nothing from it.
TEST(LateSum, IsThatOfWhenItWasAsked)
{
    for (const int n : {1000, 1000000})
    {
        Buffer<scalar> values(std::vector<scalar>(n, 1));
        Buffer<ScalarSum> scratch;
        LateSum<ScalarSum> sum;
        sum.ask(n, ReadScalar{values.span()});
        values.setZero();
        EXPECT_EQ(reduce(n, ReadScalar{values.span()}, scratch).value, 0);
        EXPECT_EQ(sum.take().value, n);                 // ones: exact
    }
}

TEST(Accumulator, FoldsOverSeveralCallsAndBeginsAnew)
{
    Accumulator<LongSum> sum;
    sum.ask();
    EXPECT_EQ(sum.take().value, 0);
    for (int repeat = 0; repeat < 2; ++repeat)
    {
        sum.add(3, Squares{});          // 0 + 1 + 4
        sum.add(5000, Squares{});
        sum.ask();
        EXPECT_EQ(sum.take().value, 5 + 4999L * 5000 * 9999 / 6);
        sum.ask();
        EXPECT_EQ(sum.take().value, 0);
    }
}
