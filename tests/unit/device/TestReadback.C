// SPDX-License-Identifier: GPL-3.0-or-later
// Words that are read while the device goes on.

#include "device/Readback.H"

#include "device/ForEach.H"

#include <gtest/gtest.h>

using namespace shizuku;

namespace
{

struct AddTo
{
    Span<std::uint32_t> values;

    HOST_DEVICE void operator()(int i) const { values[i] += std::uint32_t(i); }
};

}

// What was written before it was asked for, and nothing of what comes later; as often as anybody asks, of as many as there are.
TEST(Readback, BringsWhatStoodThereWhenItWasAskedFor)
{
    Readback readback;
    for (const int n : {3, 1000, 1})
    {
        Buffer<std::uint32_t> values(n);
        values.setZero();
        for (std::uint32_t turn = 1; turn < 4; ++turn)
        {
            forEach(n, AddTo{values.span()});
            readback.ask(values);
            const std::uint32_t* words = readback.wait();
            for (int i = 0; i < n; ++i) ASSERT_EQ(words[i], turn * std::uint32_t(i));
        }
        readback.ask(values);
        forEach(n, AddTo{values.span()});
        EXPECT_EQ(readback.wait()[n - 1], 3 * std::uint32_t(n - 1));
    }
}
