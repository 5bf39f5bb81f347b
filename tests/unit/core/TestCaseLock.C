// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/CaseLock.H"
#include "unit/core/TimedCase.H"

using namespace shizuku;
using namespace shizuku::test;

TEST(CaseLock, LetsOneSolverIn)
{
    const TimedCase folder(tenSteps);
    {
        const CaseLock held(folder.path());
        EXPECT_TRUE(holds(messageOf<FatalError>([&] { CaseLock{folder.path()}; }), {"Another solver", folder.path().string()}));
        EXPECT_NO_THROW(CaseLock{folder.path() / "system"});
    }
    EXPECT_NO_THROW(CaseLock{folder.path()});
    EXPECT_EQ(folder.list(), (Names{"0", "system"}));       // it leaves nothing
}
