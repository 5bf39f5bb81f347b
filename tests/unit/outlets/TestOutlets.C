// SPDX-License-Identifier: GPL-3.0-or-later
#include "outlets/Outlets.H"

#include "device/Device.H"
#include "support/LiquidCase.H"

#include <gtest/gtest.h>

#include <map>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// 5 x 5 x 5 particles at whole numbers of spacings (1 mm) from 0 to 4, whose velocities tell which they are.
class Block : public LiquidCase
{
public:
    Block()
    {
        const std::vector<Vec3> points = latticeBlock(5, 5, 5, 1, {0, 0, 0});
        place(points, points);
    }

    Outlets outlets(const std::string& text)
    {
        folder.write("constant/outlets", text);
        return Outlets(folder.path(), liquid);
    }

    // How many particles there are at or above each height, by their velocities; and each has the place that goes with its velocity and its number.
    std::map<int, int> heights() const
    {
        const std::vector<Vec3> u = liquid.velocity.download();
        const std::vector<Vector3> x = liquid.positions();
        const std::vector<std::uint32_t> id = liquid.id.download();
        EXPECT_EQ(x.size(), u.size());
        std::map<int, int> result;
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            ++result[int(std::lround(u[i].z))];
            EXPECT_NEAR(x[i].x, 1e-3*u[i].x, 1e-8);
            EXPECT_NEAR(x[i].y, 1e-3*u[i].y, 1e-8);
            EXPECT_NEAR(x[i].z, 1e-3*u[i].z, 1e-8);
            const Vec3 first = latticeBlock(5, 5, 5, 1, {0, 0, 0})[id[i]];
            EXPECT_EQ(first.x, u[i].x);
            EXPECT_EQ(first.y, u[i].y);
            EXPECT_EQ(first.z, u[i].z);
        }
        return result;
    }

    double number(const std::string& outlet) const { return liquid.numbers().at(Outlets::numberOf(outlet)); }
};

const std::string below = "gully { type plane; point (0 0 1.5e-3); normal (0 0 -2); }\n";

}

TEST(Outlets, APlaneTakesOutWhatIsBeyondIt)
{
    Block block;
    Outlets outlets = block.outlets(below);
    EXPECT_EQ(outlets.takeOut(block.liquid), 50);
    EXPECT_EQ(block.liquid.owned(), 75);
    EXPECT_EQ(block.heights(), (std::map<int, int>{{2, 25}, {3, 25}, {4, 25}}));
    EXPECT_EQ(block.number("gully"), 50);
    // 50 mm3.
    EXPECT_EQ(outlets.report(block.liquid.numbers(), block.liquid.properties().particleVolume()), "gully 50 particles, 5e-08 m3");

    // What is left goes on.
    block.near.update(block.liquid);
    EXPECT_EQ(outlets.takeOut(block.liquid), 0);
    EXPECT_EQ(block.heights().size(), 3u);
}

TEST(Outlets, BoxesTakeOutWhatComesInOrLeaves)
{
    Block in;
    EXPECT_EQ(in.outlets("drain { type box; min (0.5e-3 0.5e-3 -1); max (3.5e-3 3.5e-3 0.5e-3); }").takeOut(in.liquid), 9);
    EXPECT_EQ(in.heights(), (std::map<int, int>{{0, 16}, {1, 25}, {2, 25}, {3, 25}, {4, 25}}));

    Block out;
    EXPECT_EQ(out.outlets("sky { type outside; min (-1e-3 -1e-3 -1e-3); max (5e-3 5e-3 2.5e-3); }").takeOut(out.liquid), 50);
    EXPECT_EQ(out.heights(), (std::map<int, int>{{0, 25}, {1, 25}, {2, 25}}));
}

TEST(Outlets, OfSeveralTheFirstOneCounts)
{
    Block block;
    Outlets outlets = block.outlets(below + "side { type plane; point (3.5e-3 0 0); normal (1 0 0); }");
    EXPECT_EQ(outlets.takeOut(block.liquid), 65);
    EXPECT_EQ(block.number("gully"), 50);
    EXPECT_EQ(block.number("side"), 15);
}

TEST(Outlets, AllOfTheLiquidMayLeave)
{
    Block block;
    Outlets outlets = block.outlets("all { type plane; point (0 0 -1); normal (0 0 1); }");
    EXPECT_EQ(outlets.takeOut(block.liquid), 125);
    EXPECT_EQ(block.liquid.owned(), 0);
    EXPECT_EQ(outlets.takeOut(block.liquid), 0);
}

TEST(Outlets, NoneCostsNothing)
{
    Block block;
    Outlets outlets = block.outlets("");
    const long launches = deviceCounters().launches;
    EXPECT_EQ(outlets.takeOut(block.liquid), 0);
    EXPECT_EQ(deviceCounters().launches, launches);
    EXPECT_EQ(outlets.report(block.liquid.numbers(), 1), "");
    EXPECT_TRUE(Outlets::names(block.folder.path()).empty());
}

TEST(Outlets, RefuseWhatTheyDoNotKnow)
{
    Block block;
    const auto message = [&](const std::string& text) { return messageOf([&] { block.outlets(text); }); };
    EXPECT_TRUE(holds(message("a { type drain; }"), {"outlet", "'drain'", "box", "outside", "plane"}));
    EXPECT_TRUE(holds(message("a { type plane; point (0 0 0); normal (0 0 0); }"), {"normal"}));
    EXPECT_TRUE(holds(message("a { type box; min (0 0 0); max (1 1 0); }"), {"max", "below that of max"}));
    EXPECT_TRUE(holds(message("a { type plane; point (0 0 0); normal (0 0 1); depth 1; }"), {"'depth'"}));
    std::string many;
    for (int k = 0; k < 9; ++k) many += "o" + std::to_string(k) + " { type plane; point (0 0 -1); normal (0 0 -1); }\n";
    EXPECT_TRUE(holds(message(many), {"9 outlets", "8 at most"}));
}
