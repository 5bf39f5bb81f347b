#include "DropCase.H"

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
    const Outcome outcome = plot("-case " + path().string());
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(read("postProcessing/probeAngle/0/angle.png").substr(1, 3), "PNG");
    EXPECT_TRUE(holds(read("postProcessing/probeAngle/0/angle.svg"), {"contact angle [deg]", "prescribed", "drop 1"}));
    EXPECT_TRUE(holds(read("postProcessing/drop/0.01/liquidState.svg"), {"volume [m3]"}));
    EXPECT_FALSE(fs::exists(path()/"postProcessing/drop/0/liquidState.svg"));
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
