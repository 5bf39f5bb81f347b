// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/CaseSetup.H"

#include "caseFiles/VectorField.H"
#include "support/LiquidCase.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// A drop above a plane: eight particles a spacing apart, or less.
class SmallCase : public testing::Test
{
protected:
    SmallCase()
    {
        folder.write("system/controlDict", "deltaT 1e-3; endTime 1; writeInterval 1;");
        folder.write("system/solution", "spacing 1e-3;");
        folder.write("constant/liquidProperties", "rho 1000; nu 1e-6; sigma 0.072;");
        folder.write("constant/models", "pressure pbf; surfaceTension none; wetting none; viscosity none; bodyForce none;");
        folder.write("constant/walls", floorPlane);
        place(1e-3, 1e-3);
    }

    // A cube of eight, its lowest corners that high, m.
    void place(double gap, double height)
    {
        std::vector<Vector3> positions;
        for (int i = 0; i < 8; ++i) positions.emplace_back(gap * (i & 1), gap * (i >> 1 & 1), height + gap * (i >> 2));
        std::filesystem::create_directories(folder.path() / "0/liquid");
        writeField(folder.path() / "0/liquid/positions", toField("positions", dimensions::length, positions), {});
        writeField(folder.path() / "0/liquid/U", toField("U", dimensions::velocity, std::vector<Vector3>(8)), {});
    }

    std::string refusal() const
    {
        return messageOf([&]
        {
            const Time time(folder.path());
            CaseSetup setup(folder.path());
            setup.make(time.value());
            setup.readParticles(time);
            setup.refuseBadStart(time);
        });
    }

    ScratchFolder folder;
};

}

TEST_F(SmallCase, IsMadeFromItsFiles)
{
    const Time time(folder.path());
    CaseSetup setup(folder.path());
    setup.make(time.value());
    setup.readParticles(time);
    setup.refuseBadStart(time);
    EXPECT_EQ(setup.liquid->owned(), 8);
    EXPECT_EQ(setup.walls->surfaces(), 1);
    EXPECT_FALSE(setup.models->forces.active());
    EXPECT_FALSE(setup.relaxes);
}

TEST_F(SmallCase, IsRefusedWithWhatIsWrong)
{
    EXPECT_EQ(refusal(), "no error");
    place(1e-3, -5e-3);
    EXPECT_TRUE(holds(refusal(), {"floor"}));
    place(1e-4, 1e-3);
    EXPECT_TRUE(holds(refusal(), {"overlapping itself", "0/liquid/positions"}));
    folder.write("system/solution", "spacing 1e-3; overlap relax;");
    EXPECT_TRUE(holds(refusal(), {"system/solution", "'overlap'"}));
    folder.write("constant/liquidProperties", "rho 1000; nu 1e-6; sigma 0.072; colour 3;");
    EXPECT_TRUE(holds(refusal(), {"constant/liquidProperties", "'colour'"}));
}

// As checkCase goes on: the liquid is there although its dictionary has an entry too many, and then walls and models can be made.
TEST_F(SmallCase, GoesOnBehindAnEntryThatNobodyKnows)
{
    folder.write("constant/liquidProperties", "rho 1000; nu 1e-6; sigma 0.072; colour 3;");
    CaseSetup setup(folder.path());
    setup.readSolution();
    setup.readLiquidProperties();
    EXPECT_TRUE(holds(messageOf([&] { setup.makeLiquid(); }), {"'colour'"}));
    ASSERT_NE(setup.liquid, nullptr);
    setup.makeWalls(0);
    setup.makeModels();
    EXPECT_NE(setup.models, nullptr);
}

TEST_F(SmallCase, IsMovedApartWhereItAsksForThat)
{
    place(5e-4, 2e-3);                                  // eight times as dense as a lattice
    folder.write("system/solution", "spacing 1e-3; overlaps relax;");
    const Time time(folder.path());
    CaseSetup setup(folder.path());
    setup.make(time.value());
    setup.readParticles(time);
    setup.refuseBadStart(time);
    ASSERT_TRUE(measureCrowding(*setup.liquid).overlaps());
    Neighbourhood near(*setup.liquid);
    EXPECT_GT(setup.relaxOverlap(time, near), 0);
    EXPECT_FALSE(measureCrowding(*setup.liquid).overlaps());
}
