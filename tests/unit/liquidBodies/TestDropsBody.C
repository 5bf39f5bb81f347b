// SPDX-License-Identifier: GPL-3.0-or-later
#include "liquidBodies/PlaceBalls.H"
#include "liquidBodies/dropSizes/DropSizes.H"
#include "reference/Rain.H"
#include "unit/liquidBodies/Bodies.H"

#include <numbers>
#include <random>

namespace shizuku::test
{

TEST(PlacedBalls, AreApartInsideTheBoxAndTheSameForASeed)
{
    const Bounds box{{1, 2, 3}, {11, 12, 8}};
    const std::vector<double> radii = {0.4, 0.2, 1, 0.3};
    std::vector<double> many;
    for (int i = 0; i < 100; ++i) many.insert(many.end(), radii.begin(), radii.begin() + (i < 10 ? 4 : 2));
    const PlacedBalls balls(box, many, 0.1, 1, "test");
    ASSERT_EQ(balls.placed(), many.size());
    double cubes = 0;
    for (std::size_t i = 0; i < balls.placed(); ++i)
    {
        const double radius = balls.radii()[i];
        const Vector3& x = balls.centres()[i];
        cubes += radius*radius*radius;
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(x[c] - radius >= box.low[c] - 1e-9 && x[c] + radius <= box.high[c] + 1e-9);
        for (std::size_t j = 0; j < i; ++j) EXPECT_GE(length(x - balls.centres()[j]), radius + balls.radii()[j] + 0.1 - 1e-9);
        EXPECT_TRUE(balls.contains(x + Vector3(0.99*radius, 0, 0)));
        EXPECT_FALSE(balls.contains(x + Vector3(1.01*radius, 0, 0)));
        EXPECT_EQ(balls.nearest(x + Vector3(0, 0, 1.04*radius), 0.1), int(i));
    }
    EXPECT_NEAR(balls.volume(), 4*std::numbers::pi/3*cubes, 1e-9);
    EXPECT_EQ(PlacedBalls(box, many, 0.1, 1, "test").centres(), balls.centres());
    EXPECT_NE(PlacedBalls(box, many, 0.1, 2, "test").centres(), balls.centres());
}

// What the standard says of its engine, and nothing that a machine rounds: whole multiples of 2^-40 of the longest edge.
TEST(PlacedBalls, PlacesAreTheSameOnEveryMachine)
{
    const PlacedBalls one({{0, 0, 0}, {1, 1, 1}}, {0.25}, 0, 1, "test");
    std::mt19937_64 random(1);
    for (int c = 0; c < 3; ++c)
    {
        const double share = double(random() >> 11)*0x1p-53;
        EXPECT_EQ(one.centres()[0][c], std::nearbyint((0.25 + 0.5*share)*0x1p40)*0x1p-40);
    }
}

TEST(PlacedBalls, ThoseThatFindNoPlaceAreLeftOut)
{
    const PlacedBalls balls({{0, 0, 0}, {4, 4, 4}}, std::vector<double>(64, 0.9), 0.2, 1, "test");
    EXPECT_EQ(balls.wanted(), 64u);
    // Two a direction fit beside each other whatever is drawn, or nearly; 27 would stand on a lattice.
    EXPECT_GE(balls.placed(), 4u);
    EXPECT_LE(balls.placed(), 8u);
    EXPECT_EQ(balls.nextRadius(), 0.9);
}

namespace
{

std::unique_ptr<DropSizes> sizes(const std::string& text)
{
    const Dictionary dict = Dictionary::parse(text, "sizes");
    return DropSizesTable::New("drop size", dict.lookup<std::string>("type"), dict.where("type"), dict);
}

}

TEST(DropSizes, FollowTheirDistributions)
{
    EXPECT_EQ(sizes("type oneSize; diameter 2e-3;")->diameter(0.7), 2e-3);

    // Shares of 2, 1 and 1 of four.
    const auto table = sizes("type table; diameters (1 2 3); shares (2 1 1);");
    EXPECT_EQ(table->diameter(0.49), 1);
    EXPECT_EQ(table->diameter(0.51), 2);
    EXPECT_EQ(table->diameter(0.76), 3);
    EXPECT_EQ(table->diameter(0.999999), 3);

    // Of exp(-D/m) between a and b the share below D is (1 - exp(-(D - a)/m))/(1 - exp(-(b - a)/m)).
    const auto exponential = sizes("type exponential; meanDiameter 0.5; minDiameter 1; maxDiameter 3;");
    EXPECT_EQ(exponential->diameter(0), 1);
    EXPECT_LE(exponential->diameter(1 - 0x1p-53), 3);
    for (const double share : {0.1, 0.5, 0.9, 0.999})
    {
        const double D = exponential->diameter(share);
        EXPECT_NEAR((1 - std::exp(-(D - 1)/0.5))/(1 - std::exp(-2/0.5)), share, 1e-12);
    }

    // Marshall and Palmer's figures at 10 mm/h: a slope of 4.1*10^-0.21 = 2.528 a millimetre. Gunn and Kinzer 1949 measured 4.03, 6.49 and 9.09 m/s of drops
    // of 1, 2 and 5 mm, which the formula meets to 2 %.
    EXPECT_NEAR(meanRainDrop(10/3.6e6), 1e-3/2.528, 1e-7);
    EXPECT_NEAR(terminalSpeed(1e-3), 4.03, 0.08);
    EXPECT_NEAR(terminalSpeed(2e-3), 6.49, 0.13);
    EXPECT_NEAR(terminalSpeed(5e-3), 9.09, 0.18);

    EXPECT_TRUE(holds(messageOf([] { sizes("type exponential; minDiameter 1; maxDiameter 2; rainRate 1; meanDiameter 1;"); }), {"both", "one of them"}));
    EXPECT_TRUE(holds(messageOf([] { sizes("type exponential; minDiameter 2; maxDiameter 2; rainRate 1;"); }), {"largest", "above minDiameter"}));
    EXPECT_TRUE(holds(messageOf([] { sizes("type table; diameters (1 2); shares (1);"); }), {"2 diameters and 1 shares"}));
    EXPECT_TRUE(holds(messageOf([] { sizes("type table; diameters (1 -2); shares (1 1);"); }), {"diameters", "above 0"}));
}

namespace
{

const std::string boxOfDrops = "type drops; min (0 0 0); max (0.02 0.02 0.02); gap 1e-4; ";

}

TEST(DropsBody, HoldsTheNumberOrTheVolumeThatIsAskedFor)
{
    // 200 balls of 1 mm, of 524 particles of 0.1 mm each.
    const auto number = makeBody(boxOfDrops + "number 200; sizes { type oneSize; diameter 1e-3; }");
    EXPECT_NEAR(number->volume(), 200*std::numbers::pi/6*1e-9, 1e-15);
    const auto points = number->fill(1e-4, {});
    EXPECT_EQ(points.size(), 200u*524);
    EXPECT_EQ(points, makeBody(boxOfDrops + "number 200; sizes { type oneSize; diameter 1e-3; }")->fill(1e-4, {}));
    EXPECT_NE(points, makeBody(boxOfDrops + "number 200; seed 2; sizes { type oneSize; diameter 1e-3; }")->fill(1e-4, {}));

    // Water that would stand 0.2 mm high, to half a largest drop.
    const auto depth = makeBody(boxOfDrops + "depth 2e-4; sizes { type exponential; meanDiameter 5e-4; minDiameter 5e-4; maxDiameter 2e-3; }");
    EXPECT_NEAR(depth->volume(), 2e-4*4e-4, 0.5*std::numbers::pi/6*8e-9);
}

TEST(DropsBody, EachDropFallsAtItsOwnSpeed)
{
    const ScratchFolder folder;
    folder.write("constant/models", "bodyForce gravity;");
    folder.write("constant/g", "dimensions [0 1 -2 0 0 0 0]; value (0 0 -9.81);");
    const auto drops = makeBody(boxOfDrops + "number 50; speeds terminal; sizes { type table; diameters (1e-3 2e-3); shares (1 1); }", folder.path());
    ASSERT_TRUE(drops->hasVelocities());
    std::size_t small = 0, large = 0;
    for (const Vector3& x : drops->fill(1e-4, {}))
    {
        // Whole micrometres a second.
        const double speed = -drops->velocityAt(x).z;
        const bool isSmall = std::abs(speed - terminalSpeed(1e-3)) < 1e-6;
        EXPECT_TRUE(isSmall || std::abs(speed - terminalSpeed(2e-3)) < 1e-6) << speed;
        ++(isSmall ? small : large);
    }
    // 524 and 4,189 particles a drop.
    EXPECT_EQ(small%524, 0u);
    EXPECT_EQ(large%4189, 0u);
    EXPECT_EQ(small/524 + large/4189, 50u);
}

TEST(DropsBody, RefusesWhatItCannotDo)
{
    const auto message = [&](const std::string& text) { return messageOf([&] { makeBody(boxOfDrops + text); }); };
    const std::string one = " sizes { type oneSize; diameter 1e-3; }";
    EXPECT_TRUE(holds(message(one), {"neither number nor depth"}));
    EXPECT_TRUE(holds(message("number 1; depth 1;" + one), {"both number and depth"}));
    EXPECT_TRUE(holds(message("number 0;" + one), {"0 drops", "1 to"}));
    EXPECT_TRUE(holds(message("depth 1e-9;" + one), {"no whole drop"}));
    EXPECT_TRUE(holds(message("number 20000;" + one), {"of the 20000 drops fill", "a smaller gap"}));
    EXPECT_TRUE(holds(message("number 1; sizes { type oneSize; diameter 0.03; }"), {"larger than the box"}));
    EXPECT_TRUE(holds(message("number 1; speeds terminal;" + one), {"has no gravity", "bodyForce gravity"}));
    EXPECT_TRUE(holds(message("number 1; sizes { type many; }"), {"drop size", "'many'", "exponential", "oneSize", "table"}));
}

}
