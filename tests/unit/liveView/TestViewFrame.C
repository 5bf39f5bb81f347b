// SPDX-License-Identifier: GPL-3.0-or-later
#include "liveView/CaseScene.H"
#include "liveView/ViewFrame.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>

using namespace shizuku;

namespace
{

struct Decoded
{
    std::string text;
    std::vector<std::uint16_t> words;
};

Decoded decode(const std::string& message)
{
    std::uint32_t length = 0;
    std::memcpy(&length, message.data(), sizeof length);
    Decoded decoded{message.substr(sizeof length, length), {}};
    const std::size_t begin = sizeof length + length;
    decoded.words.resize((message.size() - begin)/sizeof(std::uint16_t));
    std::memcpy(decoded.words.data(), message.data() + begin, message.size() - begin);
    return decoded;
}

ViewFrame row(int particles)
{
    ViewFrame frame;
    frame.spacing = 1e-4;
    for (int i = 0; i < particles; ++i)
    {
        frame.positions.push_back({1e-4*i, -1e-4*i, 2});
        frame.values.push_back(i);
    }
    return frame;
}

}

TEST(ViewFrame, PlacesAreWithinHalfAQuantum)
{
    const Decoded decoded = decode(encodeFrame(row(100), 1000));
    ASSERT_EQ(decoded.text.size()%4, 0u);       // words behind it lie as a browser wants them
    ASSERT_EQ(decoded.words.size(), 400u);
    const double size = 99e-4, quantum = size/65535;
    for (int i = 0; i < 100; ++i)
    {
        EXPECT_NEAR(decoded.words[4*i]*quantum, 1e-4*i, 0.501*quantum);
        EXPECT_NEAR(-size + decoded.words[4*i + 1]*quantum, -1e-4*i, 0.501*quantum);
        EXPECT_EQ(decoded.words[4*i + 2], 0);   // the box is flat
        EXPECT_NEAR(decoded.words[4*i + 3]*99/65535.0, i, 0.501*99/65535);
    }
    EXPECT_NE(decoded.text.find("\"particles\":100,\"shown\":100"), std::string::npos) << decoded.text;
}

TEST(ViewFrame, OfManyAnEvenShareIsSent)
{
    const Decoded decoded = decode(encodeFrame(row(100), 25));
    ASSERT_EQ(decoded.words.size(), 100u);
    for (int i = 0; i < 25; ++i) EXPECT_NEAR(decoded.words[4*i + 3]*99/65535.0, 4*i, 0.501*99/65535);
    EXPECT_NE(decoded.text.find("\"particles\":100,\"shown\":25"), std::string::npos) << decoded.text;
}

// A ball that rises by 1 m/s beside a floor: the scene has it where it is, frames only where walls move.
TEST(CaseScene, WallsAreWhereTheyAreAtTheTime)
{
    const test::ScratchFolder folder;
    folder.write("system/solution", "spacing 1e-4;\n");
    const std::string ball = "floor { type plane; point (0 0 0); normal (0 0 1); }\nball { type sphere; centre (0 0 2); radius 1; liquid outside; ";
    folder.write("constant/walls", ball + "motion { type translation; velocity (0 0 1); } }\n");
    const auto has = [](const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; };
    EXPECT_TRUE(has(sceneText(folder.path(), 0, ""), "\"point\":[0,0,2]"));
    EXPECT_TRUE(has(sceneText(folder.path(), 0.5, ""), "\"point\":[0,0,2.5]"));
    ViewFrame frame = row(1);
    frame.walls = movedWallsText(folder.path(), 0.5);
    EXPECT_TRUE(has(decode(encodeFrame(frame, 1)).text, "\"walls\":[{\"name\":\"floor\""));
    EXPECT_TRUE(has(frame.walls, "\"point\":[0,0,2.5]"));
    EXPECT_FALSE(solidMoves(folder.path()));
    folder.write("constant/walls", ball + "}\n");
    EXPECT_EQ(movedWallsText(folder.path(), 0.5), "");
    EXPECT_FALSE(has(decode(encodeFrame(row(1), 1)).text, "walls"));
}

TEST(ViewFrame, NoParticlesAndNoLimitAreWhole)
{
    EXPECT_TRUE(decode(encodeFrame(ViewFrame(), 10)).words.empty());
    EXPECT_TRUE(decode(encodeFrame(row(3), 0)).words.empty());
}

TEST(ViewFrame, TextsAndNumbersAreJson)
{
    EXPECT_EQ(jsonText("a\"b\\c\n</script>"), "\"a\\\"b\\\\c\\u000a\\u003c/script>\"");
    EXPECT_EQ(jsonNumber(std::numeric_limits<double>::quiet_NaN()), "null");
    EXPECT_EQ(jsonNumber(std::numeric_limits<double>::infinity()), "null");
    EXPECT_EQ(jsonNumbers({{"a", 1.5}, {"b", -2}}), "{\"a\":1.5,\"b\":-2}");
}
