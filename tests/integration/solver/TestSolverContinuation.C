// SPDX-License-Identifier: GPL-3.0-or-later
// A run goes on from each time that it has written to the same last state, end and tables as if it had never stopped: with sub-steps whose
// number varies, models beyond the sets' own, and function objects of each kind.

#include "SolverCase.H"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

namespace shizuku::test
{

namespace
{

class Continuation : public SolverCase
{
protected:
    Continuation()
    {
        fill({0.2, 0, -0.3});
    }

    // Of a set of the ladder, with more pressure entries and models.
    void choose(const std::string& set, const std::string& morePressure = "", const std::string& moreModels = "") const
    {
        const std::string folder = environment("SHIZUKU_DIR") + "/tests/validation/models/" + set;
        write("constant/models", "#include \"" + folder + "/models\"\nbodyForce gravity;\n" + moreModels);
        write("system/solution", "spacing 1e-3;\n#include \"" + folder + "/solution\"\npressure { " + morePressure + " }\n");
    }

    // The rows of a table, those of interrupted runs one behind the other.
    std::string rows(const std::string& name, const std::string& file) const
    {
        std::vector<std::pair<double, std::string>> starts;
        for (const auto& run : std::filesystem::directory_iterator(path()/"postProcessing"/name))
        {
            const std::string start = run.path().filename();
            starts.emplace_back(std::stod(start), start);
        }
        std::sort(starts.begin(), starts.end());
        std::string result;
        for (const auto& [time, start] : starts)
        {
            std::istringstream table(read("postProcessing/" + name + "/" + start + "/" + file));
            std::string line;
            std::getline(table, line);
            while (std::getline(table, line)) result += line + "\n";
        }
        return result;
    }

    using Tables = std::map<std::string, std::string>;
    Tables tables() const
    {
        Tables result;
        for (const auto& [name, file] : files) result[name] = rows(name, file);
        return result;
    }

    static inline const std::vector<std::pair<std::string, std::string>> files
    {
        {"drop", "liquidState.csv"}, {"energies", "energy.csv"}, {"size", "volume.csv"}, {"gauges", "probes.csv"},
        {"angle", "contactAngle.csv"}, {"spread", "spreadDiameter.csv"}, {"push", "wallForces.csv"}
    };

    // The condition holds for the row of the first step, which the control sees in the second; 4 ms later, with the sixth, it asks for the
    // end: the seventh is the last.
    static inline const std::string objects =
        "endTime 1; writeInterval 2; writeFormat binary; functions {"
        " until { type runTimeControl; conditions { slow { type minMax; functionObject drop; fields (maxSpeed); mode minimum; value 10;"
        " duration 4e-3; } } }"
        " drop { type liquidState; }"
        " energies { type energy; executeInterval 3; writeControl timeStep; writeInterval 3; }"
        " size { type volume; executeControl runTime; executeInterval 1.5e-3; }"
        " gauges { type probes; fields (rho U); probeLocations ((0 0 2e-3)); executeControl writeTime; executeInterval 2; }"
        " angle { type contactAngle; wall floor; executeInterval 2; writeControl runTime; writeInterval 5e-3; }"
        " push { type wallForces; executeInterval 2; }"
        " spread { type spreadDiameter; executeControl onEnd; } }";

    static std::size_t lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

    void expectContinuationFromEachTime() const
    {
        control(objects);
        Outcome outcome = solve();
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        std::set<int> counts;
        for (const LoggedStep& step : stepsOf(outcome.text)) counts.insert(step.subSteps);
        EXPECT_GT(counts.size(), 1u) << "every step had as many sub-steps";
        const std::vector<std::string> times{"0.002", "0.004", "0.006", "0.007"};
        for (const std::string& time : times) ASSERT_TRUE(exists(time + "/liquid/positions")) << outcome.text;
        ASSERT_FALSE(exists("0.008"));
        const Contents last = contents("0.007");
        ASSERT_NE(last.at("liquid/U"), contents("0.006").at("liquid/U"));
        const Tables whole = tables();
        EXPECT_EQ(lines(whole.at("drop")), 7u);
        EXPECT_EQ(lines(whole.at("gauges")), 2u);                       // of the second write and the fourth
        EXPECT_EQ(lines(whole.at("spread")), 2u);                       // the two walls

        // From the latest to the first: each finds tables that lead beyond where it begins, and those of the start before.
        for (const std::string start : {"0.006", "0.004", "0.002"})
        {
            SCOPED_TRACE("from " + start);
            for (const std::string& time : times)
            {
                if (time > start) remove(time);
            }
            control(objects + " startFrom startTime; startTime " + start + ";");
            outcome = solve();
            ASSERT_EQ(outcome.status, 0) << outcome.text;
            EXPECT_FALSE(exists("0.008"));
            EXPECT_TRUE(same(last, contents("0.007")));
            EXPECT_TRUE(same(whole, tables()));
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Devices, Continuation, testing::ValuesIn(devices()));

}

TEST_P(Continuation, OfTheDefault)
{
    choose("default");
    expectContinuationFromEachTime();
}

TEST_P(Continuation, OfTheDefaultForDeepLiquid)
{
    choose("default", "coarseGrid yes;", "particleShifting closePairs;");
    expectContinuationFromEachTime();
}

TEST_P(Continuation, OfPbf)
{
    choose("Fujisawa2014", "", "particleShifting closePairs;");
    expectContinuationFromEachTime();
}

TEST_P(Continuation, OfXSPH)
{
    choose("XSPH");
    expectContinuationFromEachTime();
}

TEST_P(Continuation, OfABodyThatTheLiquidMoves)
{
    dropBall();
    expectContinuationFromEachTime();
    const std::string numbers = read("0.007/uniform/liquid");
    EXPECT_NE(numbers.find("ball_pressureImpulseZ"), std::string::npos) << numbers;
    EXPECT_EQ(numbers.find("ball_pressureImpulseZ 0;"), std::string::npos) << "the liquid does not touch it";
}

TEST_P(Continuation, OfDFSPH)
{
    choose("DFSPH");
    expectContinuationFromEachTime();
}

}
