// SPDX-License-Identifier: GPL-3.0-or-later
// renderCase -movie.

#include "DropCase.H"

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

// On a path that holds the rest, but no ffmpeg. Nothing is left behind.
TEST_F(DropCase, RenderCaseSaysWhatFilmsNeed)
{
    writeTime("0", {drop(90)});
    fs::create_directories(path()/"bin");
    for (const std::string tool : {"Xvfb", "sh"})
    {
        if (fs::exists("/usr/bin/" + tool)) fs::create_symlink("/usr/bin/" + tool, path()/"bin"/tool);
    }
    const std::string film = (path()/"film.gif").string();
    const Outcome without = run("PATH=" + (path()/"bin").string() + " " + program("renderCase") + " -size 64x64 -movie " + film + " -case " + path().string());
    EXPECT_NE(without.status, 0);
    EXPECT_TRUE(holds(without.text, {"ffmpeg, which is not installed"})) << without.text;
    EXPECT_TRUE(holds(call("renderCase", "-movie film.avi").text, {"-movie has the value 'film.avi'", ".mp4 or .gif"}));
    EXPECT_TRUE(holds(call("renderCase", "-movie film.gif -rate 0").text, {"-rate"}));
    EXPECT_TRUE(holds(call("renderCase", "-movie film.gif -output a.png").text, {"Both -movie and -output"}));
    for (const auto& entry : fs::directory_iterator(path())) EXPECT_EQ(entry.path().filename().string().find("film"), std::string::npos);
}

// Of all times with a surface.
TEST_F(DropCase, RenderCaseMakesFilms)
{
    if (run("ffmpeg -version").status != 0) GTEST_SKIP() << "no ffmpeg";
    writeTime("0", {drop(90)});
    writeTime("0.01", {drop(100)});
    writeTime("0.02", {drop(100)}, false);
    const std::string film = (path()/"film.gif").string();
    const Outcome outcome = call("renderCase", "-size 64x64 -movie " + film);
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Written: " + film + ", 2 pictures"})) << outcome.text;
    EXPECT_EQ(read("film.gif").substr(0, 6), "GIF89a");
    EXPECT_FALSE(fs::exists(path()/".film.gif.pictures"));
}
