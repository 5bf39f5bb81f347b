// SPDX-License-Identifier: GPL-3.0-or-later
// adviseCase says what a case needs, predicts what the solver then needs, and changes the case only when it is told to.

#include "SolverCase.H"

#include "core/dictionary/Dictionary.H"

namespace shizuku::test
{

namespace
{

namespace fs = std::filesystem;

class AdviseCase : public SolverCase
{
protected:
    Outcome advise(const std::string& arguments = "") const { return call("adviseCase", arguments); }

    // The tutorial, as a user copies it: neither sampled nor filled.
    void copyTutorial(const std::string& name) const
    {
        fs::remove_all(path());
        fs::copy(fs::path(environment("SHIZUKU_DIR"))/"tutorials"/name, path(), fs::copy_options::recursive);
    }

    double spacingNow() const { return Dictionary::read(path()/"system/solution").lookup<double>("spacing"); }

    // The number behind the last `label` of a text.
    static double lastNumber(const std::string& text, const std::string& label)
    {
        const std::size_t at = text.rfind(label);
        EXPECT_NE(at, std::string::npos) << label << " is not in:\n" << text;
        return at == std::string::npos ? 0 : std::stod(text.substr(at + label.size()));
    }
};

INSTANTIATE_TEST_SUITE_P(Devices, AdviseCase, testing::ValuesIn(devices()));

}

TEST_P(AdviseCase, SessileDropAsItIsShipped)
{
    copyTutorial("sessileDrop");
    const Contents kept = contents();
    const Outcome outcome = advise("-explain -tolerance 0.05");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(same(kept, contents()));
    EXPECT_TRUE(holds(outcome.text, {"Liquid: 1997 particles, separate bodies 1", "capillary rules: 0.000166667 s",
        "contact angle of 60 degrees; tolerance 5 %", "take a plane for 'floor'", "Lamb 1881", "Bashforth and Adams 1883",
        "rung walls", "as it is", "as advised", "particles     1997", "sub-steps     300 of 0.000166667 s", "\nEnd\n"}));
    // 2.6 % of the height: needed where less matters.
    EXPECT_TRUE(holds(advise("-tolerance 0.02").text, {"constant/models: bodyForce gravity"}));
    EXPECT_EQ(outcome.text.find("bodyForce"), std::string::npos) << outcome.text;
}

// The tutorial's half sphere on a wall of 140 degrees: (2 - cos theta) 2^(2/3)/4 = 1.1 times a free ball's energy, 1.07 with the weight
// that the advice switches on.
TEST_P(AdviseCase, StartThatMayJumpOffIsTold)
{
    copyTutorial("sessileDrop");
    write("constant/wettability", "floor { theta 140; }\n");
    const Outcome outcome = advise("-explain");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"may jump off the wall: start with a cap of 112 degrees", "'floor' of 140 degrees",
        "with 1.07 times the energy", "error         not known, the answer is none that a stored study has: liquid starts with the energy"}));
    EXPECT_NEAR(lastNumber(outcome.text, "as a cap of "), 90, 1);         // from 308 particles next to the wall
}

// Its function object asks for the wall, which is not sampled yet.
TEST_P(AdviseCase, WallsThatAreNotSampledAreNotMissed)
{
    copyTutorial("liveAngle");
    const Outcome outcome = advise();
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"The walls are not sampled", "take a plane for 'floor'", "contact angle of 90 degrees"}));
}

TEST_P(AdviseCase, AppliedAdviceRuns)
{
    copyTutorial("sessileDrop");
    // Steps of the usual length, in place of the tutorial's, which are as long as the advice has them.
    const std::string shipped = read("system/controlDict"), key = "maxCapillaryCo  2.8;";
    ASSERT_NE(shipped.find(key), std::string::npos) << shipped;
    write("system/controlDict", std::string(shipped).replace(shipped.find(key), key.size(), "maxCapillaryCo 0.7;"));
    const Contents before = contents();
    const Outcome outcome = advise("-apply");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Wrote ", "Run ./Allclean, if there are results, and then fillLiquid again"}));
    Contents after = contents();
    for (const std::string file : {"system/solution", "system/controlDict", "constant/walls"})
    {
        EXPECT_EQ(after.at(file + ".old"), before.at(file));
        EXPECT_NE(after.at(file), before.at(file));
        after.erase(file + ".old");
        after[file] = before.at(file);
    }
    EXPECT_TRUE(same(before, after));                   // nothing else has changed
    EXPECT_GT(spacingNow(), 1.28e-4);

    const Outcome filled = run(program("fillLiquid") + " -case '" + path().string() + "'");
    EXPECT_EQ(filled.status, 0) << filled.text;
    const Outcome dry = solve("-dry-run");
    EXPECT_EQ(dry.status, 0) << dry.text;
    // What was predicted of it: the trial is filled as fillLiquid fills.
    EXPECT_EQ(lastNumber(outcome.text, "sub-steps "), lastNumber(dry.text, "steps                : "));
    EXPECT_EQ(lastNumber(outcome.text, "memory "), lastNumber(dry.text, "memory on the device : "));
    EXPECT_EQ(lastNumber(outcome.text, "particles "), lastNumber(dry.text, "Liquid particles "));
    // The change of the spacing is below what is worthwhile, the wall a plane.
    EXPECT_TRUE(holds(advise("-apply").text, {"Nothing to change"}));
}

TEST_P(AdviseCase, PredictsWhatTheSolverNeeds)
{
    // Solid particles and all. A run of a few sub-steps, which are all timed.
    control("functions { surface { type volume; } }");
    const Contents kept = contents();
    const Outcome outcome = advise("-measure");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(same(kept, contents()));
    const Outcome dry = solve("-dry-run");
    const std::size_t present = outcome.text.find("as it is"), advised = outcome.text.find("as advised");
    const std::string asItIs = outcome.text.substr(present, advised - present);
    // More sub-steps than -dry-run makes: lists of neighbours grow by a quarter where the liquid falls together, and what they outgrow is
    // kept for others; of 115 kB in all.
    const double memory = lastNumber(dry.text, "memory on the device : ");
    EXPECT_NEAR(lastNumber(asItIs, "memory "), memory, 0.12*memory);
    EXPECT_EQ(lastNumber(asItIs, "sub-steps "), lastNumber(dry.text, "steps                : "));
    EXPECT_TRUE(holds(asItIs, {"of solids 324", "measured here on "}));
    // The start, the function object, which measures a mesh at each of the four steps, and the last writing count too; six
    // digits are printed.
    const double start = lastNumber(asItIs, "s: start "), steps = lastNumber(asItIs, ", steps "),
        functions = lastNumber(asItIs, "function objects "), writing = lastNumber(asItIs, "waiting for writing ");
    // What the solver itself counts of its start, the log of which says it, is a part: of it an earlier process may have taken twice.
    EXPECT_GT(start, 0.5*lastNumber(solve().text, "Ready for the first step after "));
    EXPECT_GT(steps, 0);
    EXPECT_GT(functions, 0);
    EXPECT_GT(writing, 0);
    const double all = start + steps + functions + writing;
    EXPECT_NEAR(lastNumber(asItIs, "time "), all, 1e-5*all);
    // No fillLiquidDict: the spacing stays.
    EXPECT_EQ(outcome.text.find("system/solution: spacing"), std::string::npos) << outcome.text;
}

// The same advice as before the run: no time is left of it, and at its end another liquid.
TEST_P(AdviseCase, ARunThatIsOverIsJudgedByItsStart)
{
    const auto adviceOf = [](const std::string& text)
    {
        const std::size_t begin = text.find("\nAdvice"), end = text.find("\nPrediction");
        EXPECT_NE(end, std::string::npos) << text;
        return text.substr(begin, end - begin);
    };
    const std::string before = advise("-explain").text;
    ASSERT_EQ(solve().status, 0);
    const std::string after = advise("-explain").text;
    EXPECT_EQ(adviceOf(after), adviceOf(before));
    EXPECT_EQ(before.find("The run is over"), std::string::npos);
    EXPECT_NE(after.find("The run is over"), std::string::npos);
    EXPECT_EQ(lastNumber(after, "sub-steps "), lastNumber(before, "sub-steps "));
}

// Advice is given all the same.
TEST_P(AdviseCase, ACaseThatTheSolverRefusesHasNoTime)
{
    write("system/solution", "spacing 1.25e-3;\n");         // of particles that stand 1 mm apart
    const Contents kept = contents();
    const Outcome outcome = advise();
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(same(kept, contents()));
    EXPECT_TRUE(holds(outcome.text, {"Answer: ", "time          not known, as the solver does not start on a copy of the case: ",
        "pbfDroplet stopped:", "overlapping itself", "0.8 spacings", "\nEnd\n"}));
}

TEST_P(AdviseCase, BadInputIsRefused)
{
    const auto refused = [&](const std::string& arguments, const std::vector<std::string>& parts)
    {
        expectRefusal(parts, arguments, "", "adviseCase");
    };
    refused("-apply -tolerance 0", {"-tolerance is 0", "larger than 0 and smaller than 1"});
    refused("-apply -tolerance 2", {"-tolerance is 2"});
    refused("-tolerance much", {"much"});
    refused("-toleranse 0.1", {"-toleranse", "tolerance"});
    write("constant/liquidProperties", "rho 998;\nnu 1e-6;\nsigma -1;\n");
    refused("-apply", {"'sigma' is -1"});
    write("constant/liquidProperties", "rho 998;\nnu 1e-6;\nsigma 0.07;\n");
    remove("0/liquid");
    refused("-apply", {"The case has no liquid", "system/fillLiquidDict"});
    write("system/fillLiquidDict", "bodies { drop { type sphere; centre (0 0 0); raduis 1; } }");
    refused("-apply", {"'raduis'", "did you mean 'radius'"});
}

}
