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

// Sides of 65 pixels are made even, as H.264 in 4:2:0 has it; two pictures at 4 a second last half a second. ffprobe, of the same package, decodes every picture.
TEST_F(DropCase, RenderCaseMakesFilmsThatPlay)
{
    if (run("ffmpeg -version").status != 0) GTEST_SKIP() << "no ffmpeg";
    writeTime("0", {drop(90)});
    writeTime("0.01", {drop(100)});
    const std::string film = (path()/"film.mp4").string();
    const Outcome outcome = call("renderCase", "-size 65x65 -look plain -rate 4 -movie " + film);
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    const Outcome probe = run("ffprobe -v error -count_frames -show_entries stream=codec_name,pix_fmt,width,height,nb_read_frames,duration -of default=nw=1 " + film);
    EXPECT_EQ(probe.status, 0);
    EXPECT_TRUE(holds(probe.text, {"codec_name=h264", "width=66", "height=66", "pix_fmt=yuv420p", "duration=0.5", "nb_read_frames=2"})) << probe.text;
    const std::string head = read("film.mp4").substr(0, 4096);
    EXPECT_LT(head.find("moov"), head.find("mdat")) << "players on the web want the index in front";
}
