// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/Algorithms.H"
#include "support/PointSets.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <algorithm>

using namespace shizuku;
using namespace shizuku::test;

// Keys that differ in their upper halves alone, and few and many of them: a GPU sorts these otherwise.
TEST(Algorithms, SortTakesLongKeys)
{
    RandomNumbers random(4);
    for (const int n : {0, 1, 3000, 50021})
    {
        std::vector<std::uint64_t> keys(n);
        for (auto& key : keys) key = std::uint64_t(random(0, 500)) << 40 | 7;
        Buffer<std::uint64_t> deviceKeys(keys);
        sort(deviceKeys);
        std::sort(keys.begin(), keys.end());
        EXPECT_EQ(deviceKeys.download(), keys) << n;
    }
}

// As many as a GPU's passes take at a time, and one more; parts of a thousand and a million.
TEST(Algorithms, SumsWhatIsBefore)
{
    RandomNumbers random(6);
    for (const int n : {1, 2, 1000, 1024, 1025, 30011, 1 << 20, (1 << 20) + 1})
    {
        std::vector<std::uint32_t> numbers(n), expected(n);
        for (auto& number : numbers) number = std::uint32_t(random(0, 9));
        for (int i = 1; i < n; ++i) expected[i] = expected[i - 1] + numbers[i - 1];
        Buffer<std::uint32_t> sums(numbers);
        sumBefore(sums);
        EXPECT_EQ(sums.download(), expected) << n;
    }
}

TEST(Algorithms, SelectListsWhatIsChosenInItsOrder)
{
    RandomNumbers random(8);
    Selection selection;
    for (const int n : {20000, 0, 1, 777})
    {
        std::vector<std::uint8_t> chosen(n);
        std::vector<std::uint32_t> expected;
        for (int i = 0; i < n; ++i)
        {
            chosen[i] = random(0, 1) < 0.3f ? std::uint8_t(random(1, 255)) : 0;
            if (chosen[i]) expected.push_back(i);
        }
        select(Buffer<std::uint8_t>(chosen), selection);
        std::vector<std::uint32_t> before(n + 1);
        for (int i = 0; i < n; ++i) before[i + 1] = before[i] + (chosen[i] ? 1 : 0);
        ASSERT_EQ(selection.before.download(), before) << n;
        std::vector<std::uint32_t> indices(expected.size());
        selection.indices.download(indices.data(), int(indices.size()));
        EXPECT_EQ(indices, expected) << n;
    }
}

// Where there is room for some the first ones are listed, and all are counted.
TEST(Algorithms, SelectListsAsManyAsThereIsRoomFor)
{
    constexpr int n = 1000;
    std::vector<std::uint8_t> chosen(n);
    for (int i = 0; i < n; ++i) chosen[i] = i % 3 == 0;
    for (const std::uint32_t room : {0u, 1u, 200u, 334u, 500u})
    {
        Selection selection;
        Readback all;
        select(Buffer<std::uint8_t>(chosen), selection, int(room), all);
        EXPECT_EQ(*all.wait(), 334u);
        ASSERT_EQ(selection.indices.size(), room);
        selection.indices.resize(std::min(room, 334u));         // nothing is behind them
        const auto before = selection.before.download(), indices = selection.indices.download();
        for (int i = 0; i <= n; ++i) ASSERT_EQ(before[i], std::min(std::uint32_t(i + 2) / 3, room)) << i;
        for (std::uint32_t k = 0; k < indices.size(); ++k) ASSERT_EQ(indices[k], 3 * k);
    }
}

// Up to more than a GPU sums up in a thousand parts of a thousand.
TEST(Algorithms, ExclusiveScanReturnsTheTotalBehindThePrefixSums)
{
    RandomNumbers random(5);
    for (const int n : {0, 1, 2, 1000, 30011, 2500007})
    {
        std::vector<std::uint32_t> in(n), expected{0};
        for (auto& value : in) value = std::uint32_t(random(0, 1000));
        for (const auto value : in) expected.push_back(expected.back() + value);

        Buffer<std::uint32_t> out;
        EXPECT_EQ(exclusiveScan(Buffer<std::uint32_t>(in), out, "numbers"), expected.back());
        EXPECT_EQ(out.download(), expected);
    }
}

// Totals just above what an index counts, above 2^32, and one that is zero again modulo 2^32.
TEST(Algorithms, ExclusiveScanRefusesATotalThatNoIndexCanCount)
{
    constexpr std::uint32_t half = 1u << 31;
    Buffer<std::uint32_t> out;
    EXPECT_EQ(exclusiveScan(Buffer<std::uint32_t>({half - 2, 1}), out, "numbers"), half - 1);
    for (const auto& in : {std::vector{half - 1, 1u}, std::vector{half, half - 1, 7u}, std::vector{half, 0u, half}})
    {
        const auto scan = [&] { exclusiveScan(Buffer<std::uint32_t>(in), out, "numbers"); };
        EXPECT_TRUE(holds(messageOf<FatalError>(scan), {"Too many numbers", "at most 2147483647"}));
    }
}

// Totals beyond 32 bits.
TEST(Algorithms, ExclusiveScanOfLongNumbers)
{
    for (const int n : {0, 1, 1000, 30011, 1100000})
    {
        std::vector<std::uint64_t> in(n), expected{0};
        for (int i = 0; i < n; ++i) in[i] = std::uint64_t(i % 7) << 32 | std::uint64_t(i % 11);
        for (const auto value : in) expected.push_back(expected.back() + value);
        Buffer<std::uint64_t> out;
        EXPECT_EQ(exclusiveScan(Buffer<std::uint64_t>(in), out), expected.back());
        EXPECT_EQ(out.download(), expected);
    }
}
