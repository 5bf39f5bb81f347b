// SPDX-License-Identifier: GPL-3.0-or-later
#include "DropCase.H"

#include <chrono>
#include <sstream>

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

namespace
{

Outcome plot(const std::string& arguments) { return run(environment("SHIZUKU_DIR") + "/bin/plotCase " + arguments); }

}

TEST_F(DropCase, PlotCaseDrawsTheLatestTables)
{
    writeTime("0", {drop(90)});
    writeTime("0.01", {drop(70)});
    ASSERT_EQ(call("probeAngle").status, 0);
    write("postProcessing/drop/0/liquidState.csv", "time [s],volume [m3]\n0,1e-9\n0.01,1.1e-9\n");
    write("postProcessing/drop/0.01/liquidState.csv", "time [s],volume [m3]\n0.01,1e-9\n0.02,1.1e-9\n");
    // Of the run that was the last, though it started before the other one.
    fs::last_write_time(path()/"postProcessing/drop/0.01/liquidState.csv", fs::file_time_type::clock::now() - std::chrono::hours(1));
    const Outcome outcome = plot("-case " + path().string());
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(read("postProcessing/probeAngle/0/angle.png").substr(1, 3), "PNG");
    EXPECT_TRUE(holds(read("postProcessing/probeAngle/0/angle.svg"), {"contact angle [deg]", "prescribed", "drop 1"}));
    EXPECT_TRUE(holds(read("postProcessing/drop/0/liquidState.svg"), {"volume [mm3]"}));
    EXPECT_FALSE(fs::exists(path()/"postProcessing/drop/0.01/liquidState.svg"));
}

TEST_F(DropCase, PlotCaseDrawsFunctionObjects)
{
    write
    (
        "postProcessing/e/0/energy.csv",
        "time [s],kinetic [J],gravitational [J],surface [J],total [J]\n0,0,1e-6,nan,nan\n0.1,1e-7,9e-7,2e-6,3e-6\n"
    );
    write
    (
        "postProcessing/v/0/volume.csv",
        "time [s],volume [m3],spray [m3],particleVolume [m3],crowded [m3],drift [%]\n0,1e-9,0,1e-9,1e-9,0\n0.1,1.1e-9,1e-11,1e-9,1e-9,10\n"
    );
    write
    (
        "postProcessing/s/0/spreadDiameter.csv",
        "time [s],wall,normalX,normalY,normalZ,wettedArea [m2],wettedDiameter [m],wettedExtent [m],liquidExtent [m],height [m]\n"
        "0,tank,0,0,1,1e-6,1e-3,1e-3,2e-3,1e-3\n0,tank,nan,nan,nan,0,0,0,nan,nan\n"
        "0.1,tank,0,0,1,2e-6,2e-3,1e-3,2e-3,1e-3\n0.1,tank,1,0,0,1e-6,1e-3,1e-3,2e-3,1e-3\n"
    );
    write
    (
        "postProcessing/p/0/probes.csv",
        "time [s],probe,x [m],y [m],z [m],fill,Ux [m/s],p [Pa]\n0,0,0,0,1e-3,1,0.1,10\n0,1,0,0,2e-3,0,nan,nan\n"
        "0.1,0,0,0,1e-3,1,0.2,20\n0.1,1,0,0,2e-3,0,nan,nan\n"
    );
    write("postProcessing/t/0/stepTime.csv", "time [s],wall [ms]\n0.1,3\n0.2,4\n");
    const Outcome outcome = plot("-case " + path().string());
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Left out of ", "probes.csv, for want of numbers: probe 1 (0 0 2) mm\n"}));
    EXPECT_FALSE(holds(outcome.text, {"warning"})) << outcome.text;
    const auto drawn = [&](const std::string& table, const std::vector<std::string>& texts)
    {
        const std::string file = "postProcessing/" + table;
        EXPECT_EQ(read(file + ".png").substr(1, 3), "PNG") << table;
        EXPECT_TRUE(holds(read(file + ".svg"), texts)) << table;
    };
    drawn("e/0/energy", {"energy [µJ]", "kinetic", "gravitational", "surface", "total", "time [ms]"});
    drawn("v/0/volume", {"volumes [mm3]", "spray", "particleVolume", "crowded", "drift [%]"});
    drawn("s/0/spreadDiameter", {"wettedArea [mm2]", "wettedDiameter [mm]", "height [mm]", "tank (0 0 1)", "tank (1 0 0)"});
    drawn("p/0/probes", {"Ux [m/s]", "p [Pa]", "probe 0 (0 0 1) mm", "probe 1 (0 0 2) mm", "fill"});
    drawn("t/0/stepTime", {"wall [ms]"});
}

// As text, of the run that wrote last; no picture is left.
TEST_F(DropCase, PlotCaseShowsATableWhileTheRunGoesOn)
{
    write("postProcessing/drop/0/liquidState.csv", "time [s],volume [m3],maxSpeed [m/s]\n0,1e-9,1\n0.01,1.1e-9,0.5\n");
    write("postProcessing/drop/0.01/liquidState.csv", "time [s],volume [m3],drift []\n0.01,1e-9,0\n0.02,1.1e-9,1\n");
    fs::last_write_time(path()/"postProcessing/drop/0.01/liquidState.csv", fs::file_time_type::clock::now() - std::chrono::hours(1));
    const std::string of = "-case " + path().string() + " -monitor -every 1 -times 2";
    const Outcome outcome = plot(of);
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"volume [mm3]", "maxSpeed [m/s]", "time [ms]"}));
    EXPECT_FALSE(holds(outcome.text, {"drift"}));
    EXPECT_FALSE(holds(outcome.text, {"warning"})) << outcome.text;
    EXPECT_FALSE(fs::exists(path()/"postProcessing/drop/0/liquidState.png"));
    EXPECT_NE(plot(of + " -every never").status, 0);
}

// Before the first row it waits; a chart is no wider than the terminal.
TEST_F(DropCase, PlotCaseWaitsForTheFirstRow)
{
    fs::create_directories(path()/"postProcessing/drop/0");
    const std::string table = (path()/"postProcessing/drop/0/liquidState.csv").string();
    write("postProcessing/drop/0/liquidState.csv", "time [s],volume [m3],maxSpeed [m/s]\n");
    const std::string later = "(sleep 2; printf '0,1e-9,1\\n0.01,1.1e-9,0.5\\n' >>" + table + ") & ";
    const Outcome outcome = run(later + "COLUMNS=80 " + environment("SHIZUKU_DIR") + "/bin/plotCase -case " + path().string() + " -monitor -every 1 -times 1");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Waiting for the first row", "volume [mm3]", "maxSpeed [m/s]"})) << outcome.text;
    std::istringstream lines(outcome.text.substr(outcome.text.find("volume [mm3]")));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80u) << line;
}

// Of several drops the prescribed angle has one entry in the legend, and each drop one.
TEST_F(DropCase, PlotCaseNamesEachLineOnce)
{
    write
    (
        "postProcessing/a/0/angle.csv",
        "time [s],angle [deg],prescribed [deg],volumeDrift [%],drop\n0,80,60,1,1\n0,81,60,1,2\n0.1,70,60,1,1\n0.1,71,60,1,2\n"
    );
    ASSERT_EQ(plot("-case " + path().string()).status, 0);
    const std::string chart = read("postProcessing/a/0/angle.svg");
    const auto times = [&](const std::string& text)
    {
        int count = 0;
        for (std::size_t at = chart.find(text); at != std::string::npos; at = chart.find(text, at + 1)) ++count;
        return count;
    };
    const int titles = times(">drop 1<");
    EXPECT_GT(titles, 0);
    EXPECT_EQ(times(">drop 2<"), titles);
    EXPECT_EQ(times(">prescribed<"), titles);
}

TEST_F(DropCase, PlotCaseDrawsTheOthersWhereATableHasNothingOrIsWrong)
{
    const std::string angles = "time [s],angle [deg],prescribed [deg],volumeDrift [%],drop\n";
    write("postProcessing/a/0/angle.csv", angles + "0,nan,nan,nan,1\n0.1,nan,nan,nan,1\n");
    write("postProcessing/b/0/angle.csv", angles + "0,nan,60,1,1\n0.1,nan,60,1,1\n");         // a film
    write("postProcessing/c/0/volume.csv", "time [s],volume [m3]\n0,nan\n0.1,nan\n");
    write("postProcessing/d/0/volume.csv", "time [s],volume [m3]\n0,1e-9\n0.1,1.1e-9\n");
    Outcome outcome = plot("-case " + path().string());
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Left out: ", "a/0/angle.csv has no", "c/0/volume.csv has no column of numbers"}));
    EXPECT_FALSE(holds(outcome.text, {"warning"})) << outcome.text;
    EXPECT_TRUE(holds(read("postProcessing/b/0/angle.svg"), {"prescribed"}));
    EXPECT_TRUE(fs::exists(path()/"postProcessing/d/0/volume.png"));

    fs::remove(path()/"postProcessing/d/0/volume.png");
    write("postProcessing/c/0/volume.csv", "volume [m3]\n1\n");
    outcome = plot("-case " + path().string());
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"c/0/volume.csv has neither"}));
    EXPECT_TRUE(fs::exists(path()/"postProcessing/d/0/volume.png"));

    outcome = plot((path()/"postProcessing/a/0/angle.csv").string());
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"No table has anything to be drawn"}));
}

TEST_F(DropCase, PlotCaseDrawsASweep)
{
    write("angles.csv", "prescribed [deg],measured [deg],state\n0,nan,film\n30,34,attached\n90,91,attached\n");
    const Outcome outcome = plot((path()/"angles.csv").string());
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(read("angles.svg"), {"prescribed contact angle [deg]", "measured contact angle [deg]"}));
    EXPECT_TRUE(fs::exists(path()/"angles.png"));
}

TEST_F(DropCase, PlotCaseSaysWhatIsMissing)
{
    Outcome outcome = plot("-case " + path().string());
    EXPECT_NE(outcome.status, 0);
    EXPECT_TRUE(holds(outcome.text, {"No table", "probeAngle"}));

    outcome = plot((path()/"absent.csv").string());
    EXPECT_NE(outcome.status, 0);
    EXPECT_TRUE(holds(outcome.text, {"absent.csv"}));

    write("empty.csv", "time [s],angle [deg]\n");
    EXPECT_TRUE(holds(plot((path()/"empty.csv").string()).text, {"empty.csv has no row"}));
    write("other.csv", "a,b\n1,2\n");
    EXPECT_TRUE(holds(plot((path()/"other.csv").string()).text, {"neither a column 'time'", "a,b"}));

    // Without gnuplot: a path that holds what the script needs, and no more.
    fs::create_directories(path()/"bin");
    for (const std::string tool : {"bash", "cat", "env"}) fs::create_symlink("/bin/" + tool, path()/"bin"/tool);
    outcome = run
    (
        "PATH=" + (path()/"bin").string() + " bash " + environment("SHIZUKU_DIR") + "/bin/plotCase "
      + (path()/"other.csv").string()
    );
    EXPECT_NE(outcome.status, 0);
    EXPECT_TRUE(holds(outcome.text, {"gnuplot is not installed", "gnuplot-nox"}));
}
