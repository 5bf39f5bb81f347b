// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/wetting/Wetting.H"

#include "device/Device.H"
#include "support/SurfaceStates.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

std::unique_ptr<Wetting> makeWetting(LiquidCase& drop, const std::string& tensionWord)
{
    const Dictionary models = Dictionary::parse
    (
        "surfaceTension " + tensionWord + ";\nwetting extendedSurface;", "constant/models"
    );
    const auto tension = SurfaceTension::New(models, drop.liquid, drop.walls, drop.surface);
    return Wetting::New(models, drop.liquid, drop.walls, *tension);
}

}

TEST(ExtendedSurface, NeedsATensionWithAFreeSurface)
{
    for (const std::string tension : {"none", "Akinci2013", "Fujisawa2014"})
    {
        LiquidCase drop;
        EXPECT_TRUE(holds(messageOf([&] { makeWetting(drop, tension); }),
                          {"constant/models", "free surface", "surfaceTension continuumSurfaceForce"})) << tension;
    }
}

// It brings the walls' angles into the reconstruction, and has no force of its own.
TEST(ExtendedSurface, GivesTheReconstructionTheContactAngle)
{
    for (const bool on : {true, false})
    {
        LiquidCase drop({.walls = floorPlane, .wettability = on ? "floor { theta 60; }" : ""});
        const Dictionary models = Dictionary::parse
        (
            std::string("surfaceTension continuumSurfaceForce; wetting ") + (on ? "extendedSurface;" : "none;")
        );
        const auto tension = SurfaceTension::New(models, drop.liquid, drop.walls, drop.surface);
        const auto wetting = Wetting::New(models, drop.liquid, drop.walls, *tension);
        EXPECT_EQ(wetting->active(), on);
        drop.place(latticeBlock(6, 6, 3, 1, {-2.5f, -2.5f, 0.5f}));
        const double theta = (on ? 60 : 90) * std::numbers::pi / 180;
        for (const SurfaceState& state : surfaceStates(drop)) ASSERT_NEAR(state.contact.theta, theta, 1e-6);

        Buffer<Vec3> acceleration(drop.liquid.all());
        acceleration.setZero();
        const DeviceCounters before = deviceCounters();
        wetting->apply(drop.liquid, drop.near, drop.walls, acceleration);
        EXPECT_EQ(deviceCounters().launches, before.launches);
        for (const Vec3& a : acceleration.download()) ASSERT_EQ(norm(a), 0);
    }
}
