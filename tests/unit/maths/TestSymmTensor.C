// SPDX-License-Identifier: GPL-3.0-or-later
// Invariants of a symmetric tensor.

#include "maths/SymmTensor.H"

#include <gtest/gtest.h>

using namespace shizuku;

// Whole numbers: exact. The tensor times its adjugate is the determinant, 2 (3 7 - 1) + 1 (-7 - 4) + 4 (-1 - 12) = -23, times the unit tensor.
TEST(SymmTensor, TimesItsAdjugateIsItsDeterminant)
{
    const SymmTensor<Vec3> t{{2, 3, 7}, {-1, 1, 4}};
    EXPECT_EQ(trace(t), 12);
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    {
        const Vec3 back = t * (adjugate(t) * axis);
        EXPECT_EQ(norm(back - scalar(-23) * axis), 0);
    }
}
