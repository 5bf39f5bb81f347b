// SPDX-License-Identifier: GPL-3.0-or-later
// What the profile counts and calls things.

#include "device/Profile.H"

#include "device/Algorithms.H"
#include "device/ForEach.H"

#include <gtest/gtest.h>

#include <chrono>

using namespace shizuku;

namespace
{

template<class T>
struct Fill
{
    Span<T> values;

    HOST_DEVICE void operator()(int i) const { values[i] = T(i); }
};

}

TEST(Profile, CountsTheCallsOfEachKernelWhileItIsOn)
{
    Buffer<std::uint32_t> keys(1000), values(1000);
    Buffer<float> numbers(1000);
    const auto work = [&]
    {
        forEach(1000, Fill<std::uint32_t>{keys.span()});
        forEach(1000, Fill<std::uint32_t>{values.span()});
        forEach(1000, Fill<float>{numbers.span()});
        sumBefore(keys);
    };
    work();
    startProfile();
    const auto begin = std::chrono::steady_clock::now();
    work();
    const auto times = stopProfile();
    const double wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    work();
    const auto callsOf = [&](const std::string& name)
    {
        long calls = 0;
        for (const KernelTime& time : times) calls += time.kernel == name ? time.calls : 0;
        return calls;
    };
    EXPECT_EQ(times.size(), 3u);
    EXPECT_EQ(callsOf("Fill<unsigned int>"), 2);
    EXPECT_EQ(callsOf("Fill<float>"), 1);
    EXPECT_EQ(callsOf("scan"), 1);
    for (std::size_t k = 1; k < times.size(); ++k) EXPECT_GE(times[k - 1].milliseconds, times[k].milliseconds);
    // Each took some time, and all of them one behind the other no more than passed by the clock; a GPU's own ticks in half microseconds.
    EXPECT_GT(times.back().milliseconds, 0);
    double all = 0;
    for (const KernelTime& time : times) all += time.milliseconds;
    EXPECT_LE(all, wall + 1e-3 * double(times.size()));
    startProfile();
    EXPECT_TRUE(stopProfile().empty());
}
