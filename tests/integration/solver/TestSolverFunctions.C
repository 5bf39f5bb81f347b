// SPDX-License-Identifier: GPL-3.0-or-later
// Function objects of a run: where their tables go, and what needs the solver to be measured.

#include "SolverCase.H"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

namespace shizuku::test
{

namespace
{

class Functions : public SolverCase
{
protected:
    // The numbers of a table below postProcessing, row by row; "nan" for text.
    std::vector<std::vector<double>> rows(const std::string& table) const
    {
        std::vector<std::vector<double>> result;
        std::istringstream stream(read("postProcessing/" + table));
        std::string line, cell;
        std::getline(stream, line);
        while (std::getline(stream, line))
        {
            result.emplace_back();
            std::istringstream cells(line);
            while (std::getline(cells, cell, ','))
            {
                char* end = nullptr;
                const double value = std::strtod(cell.c_str(), &end);
                result.back().push_back(end == cell.c_str() ? NAN : value);
            }
        }
        return result;
    }
};

INSTANTIATE_TEST_SUITE_P(Devices, Functions, testing::ValuesIn(devices()));

}

TEST_P(Functions, AllOfThemInOneRun)
{
    control
    (
        "functions { size { type volume; } energies { type energy; } angle { type contactAngle; wall floor; }"
        " spread { type spreadDiameter; executeControl onEnd; }"
        " gauges { type probes; fields (rho U p); probeLocations ((0 0 2e-3)); executeInterval 2; } }"
    );
    Outcome outcome = solve();
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(rows("size/0/volume.csv").size(), 4u);
    EXPECT_EQ(rows("energies/0/energy.csv").size(), 4u);
    EXPECT_EQ(rows("angle/0/contactAngle.csv").size(), 4u);
    EXPECT_EQ(rows("spread/0/spreadDiameter.csv").size(), 2u);          // the analytic wall and the sampled floor
    EXPECT_EQ(rows("gauges/0/probes.csv").size(), 2u);
    EXPECT_TRUE(holds(read("postProcessing/spread/0/spreadDiameter.csv"), {"0.004,side,1,0,0,", "0.004,floor,0,0,1,"}));
    const double block = particles*spacing*spacing*spacing;
    EXPECT_NEAR(rows("size/0/volume.csv").back()[1], block, 0.012*block);   // twice the 0.6 % that its rounded edges take
    EXPECT_FALSE(std::isnan(rows("energies/0/energy.csv").back()[4]));
    EXPECT_EQ(rows("angle/0/contactAngle.csv").back()[3], 60);

    // A restart has a folder of its own.
    control("endTime 6e-3; functions { size { type volume; } }");
    outcome = solve();
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(rows("size/0.004/volume.csv").size(), 2u);
    EXPECT_EQ(rows("size/0/volume.csv").size(), 4u);
}

// What postProcess makes of stored times is what the run had there, every second of whose times is written. Places and velocities are stored to the bit, and so are
// their sums; sums over neighbours differ as lists do that were made before the pressure of the step: 1e-3 of densities, 1e-8 of the volume.
TEST_P(Functions, StoredTimesHaveTheRowsOfTheRun)
{
    fill({0.1, 0, -0.3});
    control
    (
        "writeInterval 2; functions { drop { type liquidState; } box { type boundingBox; executeControl writeTime; } angle { type contactAngle; wall floor; }"
        " gauges { type probes; fields (rho U); probeLocations ((0 0 2e-3)); } timing { type stepTime; } off { type energy; enabled no; } }"
    );
    ASSERT_EQ(solve().status, 0);
    const auto before = contents("postProcessing");
    const Outcome outcome = call("postProcess", "-time 0.001:");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"The function object 'timing' needs a run: the time that its steps take. It is left out"}));
    for (const auto& [file, bytes] : before)
    {
        if (file.ends_with('/')) continue;
        EXPECT_EQ(read("postProcessing/" + file), bytes) << file;         // the run's own stay
    }
    const std::tuple<std::string, std::string, std::size_t, double> tables[] =
    {
        {"drop", "liquidState", 10, 1e-7}, {"box", "boundingBox", 7, 1e-9}, {"angle", "contactAngle", 6, 1e-6}, {"gauges", "probes", 10, 1e-3}
    };
    for (const auto& [name, file, columns, tolerance] : tables)
    {
        SCOPED_TRACE(name);
        const auto ofRun = rows(name + "/0/" + file + ".csv"), stored = rows(name + ".stored/0.002/" + file + ".csv");
        ASSERT_EQ(stored.size(), 2u);
        for (const auto& row : stored)
        {
            const auto same = std::find_if(ofRun.begin(), ofRun.end(), [&](const auto& other) { return other[0] == row[0]; });
            ASSERT_NE(same, ofRun.end()) << row[0];
            ASSERT_EQ(same->size(), row.size());
            for (std::size_t c = 0; c < std::min(columns, row.size()); ++c)
            {
                if (std::isnan((*same)[c])) EXPECT_TRUE(std::isnan(row[c])) << c;
                else EXPECT_NEAR(row[c], (*same)[c], tolerance*std::max(std::abs(row[c]), 1e-12)) << c;
            }
        }
    }
    EXPECT_FALSE(exists("postProcessing/off.stored"));

    // A type that the case does not name; what needs a run, asked for; what nobody knows.
    ASSERT_EQ(call("postProcess", "-func volume -latestTime").status, 0);
    EXPECT_EQ(rows("volume.stored/0.004/volume.csv").size(), 1u);
    expectRefusal({"The function object 'timing' needs a run", "system/controlDict"}, "-func timing", "", "postProcess");
    expectRefusal({"There is no function object 'dorp'", "drop"}, "-func dorp", "", "postProcess");
}

// As OpenFOAM's cases have them: libraries are of no use here, and what is not enabled is neither read nor run.
TEST_P(Functions, OneThatIsNotEnabledIsLeftOut)
{
    control("functions { on { type energy; libs (fieldFunctionObjects); enabled true; } off { type noSuchType; libs (a b); enabled false; } }");
    const Outcome outcome = solve();
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(rows("on/0/energy.csv").size(), 4u);
    EXPECT_FALSE(std::filesystem::exists(path()/"postProcessing/off"));
}

// A column that its pressure holds against gravity, for every pressure model: the mean over steps and over probes in its
// middle is rho g times their depth in a column of the particles' volume. Particles crowd by 1 to 3 % in it, and their layers
// show in single probes; the mean is off by 0.4 to 3.4 % in all of them: 5 % leaves half of that to devices and compilers. Those with
// a speed of sound have their step limited by it.
TEST_P(Functions, ProbesReadTheHydrostaticPressure)
{
    write("constant/walls", "tank { type box; min (-3.5e-3 -3.5e-3 0); max (3.5e-3 3.5e-3 1); }");
    control
    (
        "endTime 0.15; deltaT 2e-3; writeInterval 1000; reportInterval 40;"
        "functions { gauges { type probes; fields (p); probeLocations ((0 0 2e-3) (0 0 3e-3) (0 0 4e-3)); } }"
    );
    const std::string iterated = "minIterations 4; maxIterations 20;", sound = "maxSpeed 0.25;";
    for (const auto& [word, controls] : {std::pair{std::string("pbf"), iterated}, {"PCISPH", iterated}, {"DFSPH", iterated},
                                         {"WCSPH", sound}, {"idealGas", sound}})
    {
        removeResults();
        write("system/solution", "spacing 1e-3;\npressure { " + controls + " }\n");
        write
        (
            "constant/models",
            "pressure " + word + "; surfaceTension none; wetting none; viscosity XSPH; bodyForce gravity;"
        );
        const Outcome outcome = solve();
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        for (const LoggedStep& step : stepsOf(outcome.text)) EXPECT_EQ(step.limit == "acoustic", controls == sound) << word;
        double sum = 0;
        int count = 0;
        for (const auto& row : rows("gauges/0/probes.csv"))
        {
            if (row[0] < 0.08) continue;                        // the column has come to rest
            sum += row.back();
            ++count;
        }
        ASSERT_GT(count, 90) << word;
        const double expected = 998*9.81*3e-3;
        EXPECT_NEAR(sum/count, expected, 0.05*expected) << word;
    }
}

// The block falls at 0.3 m/s at first. A condition that holds from the first step on for 2 ms is satisfied at the third, and the
// fourth is the last: written though no time of writing, with complete tables, those at the end of the run too. Started again
// the run goes on from there for as long, to the state of a run that was not ended.
TEST_P(Functions, RunTimeControlEndsTheRunAndLeavesItComplete)
{
    fill({0, 0, -0.3});
    const std::string endless = "endTime 1; writeInterval 1000;", objects = "functions { drop { type liquidState; }"
        " spread { type spreadDiameter; wall floor; executeControl onEnd; }";
    control
    (
        endless + objects + " until { type runTimeControl; conditions { slow { type minMax; functionObject drop;"
        " fields (maxSpeed); mode minimum; value 1; duration 2e-3; } } } }"
    );
    Outcome outcome = solve();
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"The next step is the last. until: maxSpeed below 1 for 0.002 s"}));
    EXPECT_TRUE(exists("0.004/liquid/positions"));
    EXPECT_EQ(rows("drop/0/liquidState.csv").size(), 4u);
    EXPECT_EQ(rows("spread/0/spreadDiameter.csv").size(), 1u);

    outcome = solve();
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(rows("drop/0.004/liquidState.csv").size(), 4u);
    const Contents ended = contents("0.008");
    removeResults();
    control("endTime 8e-3; writeInterval 4;");
    outcome = solve();
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(same(ended, contents("0.008")));
}

TEST_P(Functions, RefuseBadEntries)
{
    control("\nfunctions { a { type contactAngle; wall wal; } }");
    expectRefusal({"'wal'", "floor", "side", "controlDict at line 8"});
    control("\nfunctions { a { type probes; fields (U); probeLocations ((0 0 zero)); } }");
    expectRefusal({"the word 'zero'", "a list of vectors", "line 8"});
    control("\nfunctions { a { type volume; executeControl rarely; } }");
    expectRefusal({"'rarely'", "writeTime", "line 8"});
    control("\nfunctions ( volume );");
    expectRefusal({"'functions' is no dictionary", "line 8"});
    control("functions { a { type volume; } }");
    write("system/meshSurfaceDict", "cell 20;");
    expectRefusal({"cell is out of range", "meshSurfaceDict"});
}

}
