#include "walls/Walls.H"

#include "support/LiquidCase.H"
#include "support/ReferenceKernels.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

const std::string sampledFloor = "floor { type particles; surface \"floor.stl\"; }";

std::string refusalOf(const CaseText& text)
{
    return messageOf([&] { LiquidCase{text}; });
}

}

// Equation (9) by direct sums over the whole layer, its rim included. Float distances and sums: a few 1e-6 at the steep
// flank.
TEST(Walls, GiveSolidParticlesTheirVirtualVolumes)
{
    for (const bool isSpline : {true, false})
    {
        const std::string kernel = isSpline ? "type cubicSpline; support 2;" : "type poly6Spiky; support 2.5;";
        const auto layer = latticeBlock(15, 13, 1, 0.9f, {-7, -6, -0.5f});
        const LiquidCase walls({.kernel = kernel, .walls = sampledFloor, .solidPositions = layer});
        const double d = walls.liquid.spacing(), h = walls.liquid.support();
        const auto view = walls.walls.view().particles;
        const auto position = download(view.position);
        const auto volume = download(view.volume);
        ASSERT_EQ(volume.size(), layer.size());
        EXPECT_EQ(walls.walls.particles(), 195);
        for (std::size_t k = 0; k < volume.size(); ++k)
        {
            double sum = 0;
            for (const Vec3& l : layer)
            {
                const double r = std::hypot(position[k].x - d * l.x, position[k].y - d * l.y, position[k].z - d * l.z);
                sum += isSpline ? Reference<CubicSpline>{h}.W(r) : Reference<Poly6Spiky>{h}.W(r);
            }
            ASSERT_NEAR(volume[k] * sum, 1, 5e-6) << k;
        }
    }
}

TEST(Walls, ReorderContactAnglesWithTheirParticles)
{
    const auto layer = randomPoints(50, {-5, -5, -0.5f}, {5, 5, -0.4f});
    std::vector<double> theta;
    for (const Vec3& p : layer) theta.push_back(90 + 10 * p.x);
    LiquidCase walls({.walls = sampledFloor, .solidPositions = layer, .solidTheta = theta});
    EXPECT_EQ(walls.walls.view().particles.cosTheta.size, 0);       // nobody asked
    walls.walls.requireContactAngles();
    const auto view = walls.walls.view().particles;
    const auto position = download(view.position);
    const auto cosine = download(view.cosTheta);
    ASSERT_EQ(cosine.size(), 50u);
    for (int k = 0; k < 50; ++k)
    {
        const double degrees = 90 + 10 * position[k].x / walls.liquid.spacing();
        EXPECT_NEAR(cosine[k], std::cos(degrees * std::numbers::pi / 180), 1e-6);       // single precision of an angle
    }
}

TEST(Walls, PutLiquidBackHalfASpacingOutside)
{
    LiquidCase drop({.walls = "floor { type plane; point (0 0 0); normal (0 0 1); }"
                              "ball { type sphere; centre (0 0 0); radius 5e-3; liquid inside; }"});
    drop.place({{0, 0, 0.2f}, {1, 0, -0.7f}, {0, 1, 3}, {0, 0, 4.9f}});
    drop.walls.project(drop.liquid);
    const auto moved = drop.inOrder(drop.liquid.predicted);
    const float d = drop.liquid.spacing();
    // Coordinates of up to five units, rounded to 5e-7.
    EXPECT_NEAR(moved[0].z, 0.5f * d, 1e-6);
    EXPECT_NEAR(moved[1].z, 0.5f * d, 1e-6);
    EXPECT_EQ(moved[1].x, d);
    EXPECT_EQ(moved[2].z, 3 * d);
    EXPECT_NEAR(moved[3].z, 4.5f * d, 1e-6);
}

TEST(Walls, StopLiquidAQuarterOfASpacingBeforeALayer)
{
    LiquidCase drop({.walls = sampledFloor, .solidPositions = latticeBlock(9, 9, 1, 1, {-4, -4, -0.5f})});
    // Before the layer, too near to it, behind it, beside its border at 4 spacings, and too near to it before the step.
    drop.place({{0.3f, 0.2f, -0.24f}, {-2, 1.5f, -0.4f}, {2.1f, -1.2f, -0.9f}, {5.2f, 0, -0.9f}, {0, 2, -0.4f}});
    const float d = drop.liquid.spacing();
    auto before = drop.liquid.position.download();
    for (Vec3& x : before) x.z = x.x == 0 ? -0.35f * d : 0;
    drop.liquid.position.upload(before);
    drop.walls.project(drop.liquid);
    const auto moved = drop.inOrder(drop.liquid.predicted);
    EXPECT_EQ(moved[0].z, -0.24f * d);
    // Averages of equal heights of half a unit, rounded to 1e-7.
    EXPECT_NEAR(moved[1].z, -0.25f * d, 1e-6);
    EXPECT_NEAR(moved[2].z, -0.25f * d, 1e-6);
    EXPECT_EQ(moved[2].x, 2.1f * d);
    EXPECT_EQ(moved[3].z, -0.9f * d);
    EXPECT_NEAR(moved[4].z, -0.35f * d, 1e-6);
}

TEST(Walls, HaveNoInnerSideWhereNormalsCancel)
{
    LiquidCase drop({.walls = sampledFloor, .solidPositions = latticeBlock(9, 9, 1, 1, {-4, -4, -0.5f}), .solidNormal = {}});
    drop.place({{0, 0, -0.4f}});
    drop.liquid.position.upload(std::vector<Vec3>{{0, 0, 0}});
    drop.walls.project(drop.liquid);
    EXPECT_EQ(drop.inOrder(drop.liquid.predicted)[0].z, -0.4f * drop.liquid.spacing());
}

TEST(Walls, RefuseLiquidThatStartsInTheSolid)
{
    LiquidCase drop({.walls = "floor { type plane; point (0 0 0); normal (0 0 1); }"});
    drop.place({{0, 0, 0.26f}, {2, 0, 3}});
    const auto check = [&] { drop.walls.refuseLiquidInside(drop.liquid); };
    EXPECT_EQ(messageOf(check), "no error");
    drop.place({{0, 0, 0.5f}, {2, 0, 0.24f}});
    EXPECT_TRUE(holds(messageOf(check), {"constant/walls", "floor", "0.0002"}));
}

TEST(Walls, CountABoxAsSixSurfaces)
{
    const LiquidCase tank({.walls = "tank { type box; min (0 0 0); max (1 2 3); }"});
    EXPECT_EQ(tank.walls.surfaces(), 6);
    EXPECT_EQ(tank.walls.particles(), 0);
    const auto view = tank.walls.view().surfaces;
    const float unit = float(tank.liquid.units().length);
    const Vec3 inside{0.5f / unit, 0.5f / unit, 2 / unit};
    float nearest = 1e9f, sum = 0;
    for (int a = 0; a < view.count; ++a)
    {
        nearest = std::min(nearest, view.surface[a](inside).distance * unit);
        sum += view.surface[a](inside).distance * unit;
    }
    EXPECT_NEAR(nearest, 0.5f, 1e-6);
    EXPECT_NEAR(sum, 6, 1e-5);          // the box's three edges together
    const std::string twoBoxes = "a { type box; min (0 0 0); max (1 1 1); } b { type box; min (0 0 0); max (1 1 1); }";
    EXPECT_EQ(refusalOf({.walls = twoBoxes}), "no error");
    EXPECT_TRUE(holds(refusalOf({.walls = twoBoxes + "c { type plane; point (0 0 0); normal (0 0 1); }"}),
                      {"constant/walls", "at most 12"}));
}

TEST(Walls, RefuseWhatIsMissing)
{
    EXPECT_TRUE(holds(refusalOf({.walls = sampledFloor}), {"constant/walls", "solid/positions", "sampleSurface"}));
    EXPECT_TRUE(holds(refusalOf({.walls = "floor { type plan; }"}), {"constant/walls", "plan", "plane"}));

    LiquidCase noAngles({.walls = sampledFloor, .solidPositions = {{0, 0, 0}}});
    EXPECT_TRUE(holds(messageOf([&] { noAngles.walls.requireContactAngles(); }), {"solid/theta", "sampleTheta"}));
}

TEST(Walls, ReadContactAnglesOfSurfaces)
{
    const std::string plane = "floor { type plane; point (0 0 0); normal (0 0 1); }";
    for (const auto& [theta, cosine] : {std::pair{"0", 1.0}, {"60", 0.5}, {"180", -1.0}})
    {
        LiquidCase drop({.walls = plane, .wettability = "floor { theta " + std::string(theta) + "; }"});
        drop.walls.requireContactAngles();
        EXPECT_NEAR(drop.walls.view().surfaces.surface[0].cosTheta, cosine, 1e-7);
    }
    LiquidCase wrong({.walls = plane, .wettability = "floor { theta 181; }"});
    EXPECT_TRUE(holds(messageOf([&] { wrong.walls.requireContactAngles(); }),
                      {"constant/wettability", "181", "0 to 180"}));
}
