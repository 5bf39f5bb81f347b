// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/HostThreads.H"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
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

TEST(HostThreads, ThrowOnWhatTheFirstPartThrew)
{
    const int threads = omp_get_max_threads();
    omp_set_num_threads(4);
    std::atomic<int> ended{0};
    const auto work = [&](std::size_t part)
    {
        if (part % 10 == 7) throw std::runtime_error(std::to_string(part));
        ++ended;
    };
    try
    {
        forEachPart(40, work);
        FAIL();
    }
    catch (const std::runtime_error& error)
    {
        EXPECT_STREQ(error.what(), "7");
    }
    EXPECT_EQ(ended, 36);
    omp_set_num_threads(threads);
}

}
