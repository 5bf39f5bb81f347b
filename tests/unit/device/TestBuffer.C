// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/Buffer.H"
#include "device/Device.H"

#include <gtest/gtest.h>

#include <numeric>

using namespace shizuku;

namespace
{

std::vector<int> counting(int n)
{
    std::vector<int> values(n);
    std::iota(values.begin(), values.end(), 1);
    return values;
}

}

TEST(Buffer, ReturnsWhatWasUploaded)
{
    const std::vector<int> values = counting(1000);
    const Buffer<int> buffer(values);
    EXPECT_EQ(buffer.size(), 1000);
    EXPECT_EQ(buffer.download(), values);
    EXPECT_EQ(buffer.span().size, 1000);
    EXPECT_TRUE(Buffer<int>().download().empty());
}

TEST(Buffer, KeepsItsElementsWhenItGrowsAndShrinks)
{
    Buffer<int> buffer(counting(100));
    buffer.resize(5000);
    buffer.setZero(100);
    const std::vector<int> grown = buffer.download();
    ASSERT_EQ(grown.size(), 5000u);
    EXPECT_EQ(std::vector<int>(grown.begin(), grown.begin() + 100), counting(100));
    buffer.resize(7);
    EXPECT_EQ(buffer.download(), counting(7));
}

TEST(Buffer, SetsZeroFromAnElementOn)
{
    Buffer<int> buffer(counting(10));
    buffer.setZero(4);
    EXPECT_EQ(buffer.download(), (std::vector<int>{1, 2, 3, 4, 0, 0, 0, 0, 0, 0}));
    buffer.setZero();
    EXPECT_EQ(buffer.download(), std::vector<int>(10, 0));
    buffer.setZero(10);     // behind the last one: nothing
    EXPECT_EQ(buffer.download(), std::vector<int>(10, 0));
}

TEST(Buffer, MovesWithoutAllocating)
{
    Buffer<int> a(counting(10)), b(counting(3));
    const std::size_t bytes = deviceCounters().bytes;
    Buffer<int> c(std::move(a));
    EXPECT_EQ(c.download(), counting(10));
    EXPECT_EQ(a.size(), 0);
    c.swap(b);
    EXPECT_EQ(c.download(), counting(3));
    EXPECT_EQ(b.download(), counting(10));
    EXPECT_EQ(deviceCounters().bytes, bytes);
}

TEST(Buffer, CountsItsMemoryAndGivesItBack)
{
    const std::size_t before = deviceCounters().bytes;
    {
        Buffer<double> buffer(1024);
        EXPECT_EQ(deviceCounters().bytes, before + 8192);
        EXPECT_GE(deviceCounters().peakBytes, before + 8192);
        buffer.resize(10);                      // memory only ever grows
        EXPECT_EQ(deviceCounters().bytes, before + 8192);
    }
    EXPECT_EQ(deviceCounters().bytes, before);
}

// A number that changes a little every step must not allocate every step.
TEST(Buffer, HasRoomForAQuarterMoreWhenItGrows)
{
    Buffer<int> buffer;
    const std::size_t none = deviceCounters().bytes;
    buffer.resizeDiscarding(512);
    EXPECT_EQ(deviceCounters().bytes, none + 2048);
    buffer.resizeDiscarding(1000);
    const std::size_t bytes = deviceCounters().bytes;
    for (int n : {1001, 10, 1250, 0, 1100})
    {
        buffer.resizeDiscarding(n);
        EXPECT_EQ(buffer.size(), n);
    }
    EXPECT_EQ(deviceCounters().bytes, bytes);
    buffer.resizeDiscarding(1281);              // 5,000 bytes are 5,120
    EXPECT_GT(deviceCounters().bytes, bytes);
}

// What one buffer has done with the next one of its size gets.
TEST(Buffer, TakesWhatAnotherLeft)
{
    constexpr int n = 123457;               // of a size that no other test leaves
    const void* left = nullptr;
    {
        Buffer<int> first(n);
        left = first.span().data;
    }
    Buffer<float> second(n), third(n);
    EXPECT_EQ(static_cast<const void*>(second.span().data), left);
    EXPECT_NE(static_cast<const void*>(third.span().data), left);
}

// What wants a little less takes it as well, and all of it; what wants a little more takes its place, so that there are not two.
TEST(Buffer, TakesALittleMoreThanItNeeds)
{
    constexpr int n = 1600000, fewer = 1300000, more = 1700000;     // of a size that no other test leaves
    const std::size_t none = deviceCounters().bytes;
    const void* left = nullptr;
    { Buffer<int> first(n); left = first.span().data; }
    {
        Buffer<int> second(fewer);
        EXPECT_EQ(static_cast<const void*>(second.span().data), left);
        const std::size_t bytes = deviceCounters().bytes;
        EXPECT_GE(bytes, none + n * sizeof(int));
        second.resize(n);
        EXPECT_EQ(deviceCounters().bytes, bytes);
    }
    { Buffer<int> large(more); left = large.span().data; }
    Buffer<int> third(n), fourth(n);
    EXPECT_EQ(static_cast<const void*>(third.span().data), left);
    EXPECT_NE(static_cast<const void*>(fourth.span().data), left);
}
