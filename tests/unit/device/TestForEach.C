#include "device/Buffer.H"
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
    const long before = deviceCounters().launches;
    forEach(0, AddIndex{buffer.span()});
    forEach(-3, AddIndex{buffer.span()});
    EXPECT_EQ(deviceCounters().launches, before);
    forEach(8, AddIndex{buffer.span()});
    forEach(1, AddIndex{buffer.span()});
    EXPECT_EQ(deviceCounters().launches, before + 2);
    synchronize();
}

TEST(Gather, TakesElementsInTheGivenOrder)
{
    const Buffer<float> from(std::vector<float>{10, 11, 12, 13});
    const Buffer<std::uint32_t> order(std::vector<std::uint32_t>{3, 0, 0, 2, 1});
    Buffer<float> to;
    gather(from, order, to);
    EXPECT_EQ(to.download(), (std::vector<float>{13, 10, 10, 12, 11}));
}
