// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/HostThreads.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

#include <omp.h>

namespace shizuku::test
{

TEST(HostThreads, VisitEachIndexOnce)
{
    const int threads = omp_get_max_threads();
    for (const int several : {1, 4})
    {
        omp_set_num_threads(several);
        for (const std::size_t n : {0, 1, 255, 256, 257, 10000})
        {
            std::vector<int> visits(n);
            forEachInParallel(n, [&](std::size_t i) { ++visits[i]; });
            EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), std::ptrdiff_t(n));
        }
    }
    omp_set_num_threads(threads);
}

TEST(HostThreads, ThrowOnWhatOneOfThemThrew)
{
    const int threads = omp_get_max_threads();
    omp_set_num_threads(4);
    std::atomic<int> ended{0};
    const auto work = [&](std::size_t part)
    {
        if (part == 7) throw std::runtime_error("seventh");
        ++ended;
    };
    EXPECT_THROW(forEachPart(20, work), std::runtime_error);
    EXPECT_EQ(ended, 19);
    omp_set_num_threads(threads);
}

}
