// SPDX-License-Identifier: GPL-3.0-or-later
// The solver in single and in double precision: the same flow to the rounding of floats, and what cannot be had is refused.

#include "SolverCase.H"

#include "core/fieldFile/FieldFile.H"

#include <cmath>

namespace shizuku::test
{

namespace
{

class Precision : public SolverCase
{
protected:
    // A field after the first step, by the particles' numbers; three components each, or one.
    std::vector<double> field(const std::string& name) const
    {
        const std::filesystem::path folder = path()/"0.0002/liquid";
        const FieldData id = readField(folder/"id"), values = readField(folder/name);
        const int n = componentsOf(values.type);
        std::vector<double> result(id.elements()*n);
        for (std::size_t i = 0; i < id.elements(); ++i)
        {
            for (int c = 0; c < n; ++c) result[std::size_t(id(i))*n + c] = values(i, c);
        }
        return result;
    }

    static double largestDifference(const std::vector<double>& a, const std::vector<double>& b)
    {
        EXPECT_EQ(a.size(), b.size());
        double most = 0;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, std::abs(a[i] - b[i]));
        return most;
    }
};

INSTANTIATE_TEST_SUITE_P(OnTheCpu, Precision, testing::Values("cpu"));

}

TEST_P(Precision, SingleAndDoubleAgreeOnAStep)
{
    fill({0.2, 0, -0.3});
    // A threshold that one precision just misses would not be rounding: a fixed number of iterations, and a support that no two of
    // the lattice's particles have between them.
    write
    (
        "system/solution",
        "spacing 1e-3;\npressure { minIterations 4; maxIterations 4; tolerance 0; }\nkernel { type cubicSpline; support 2.1; }\n"
    );
    const double dt = 2e-4;
    control("adjustTimeStep no; deltaT 2e-4; endTime 2e-4; writeFormat binary;");
    Outcome outcome = solve("-precision single");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Device : cpu, "}));
    const std::vector<double> positions = field("positions"), velocities = field("U");
    const std::string single = read("0.0002/liquid/U");
    removeResults();
    outcome = solve("-precision double");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Device : cpuDouble, "}));

    // Positions are sums of some dozens of floats of a few spacings: an ulp at 4 spacings is 4.8e-7 of a spacing, and four
    // iterations add up what each leaves; velocities have both ends of the step. That they differ by as much as float resolves
    // says that the other precision was computed with.
    const double tolerance = 1e-5*spacing, moved = largestDifference(positions, field("positions"));
    EXPECT_LT(moved, tolerance);
    EXPECT_GT(moved, 1e-7*spacing);
    EXPECT_LT(largestDifference(velocities, field("U")), 2*tolerance/dt);

    // Places have 64 bits in either precision, velocities only in double.
    const std::string twice = read("0.0002/liquid/U");
    EXPECT_TRUE(holds(single, {"scalar=32"}));
    EXPECT_TRUE(holds(twice, {"scalar=64"}));
    EXPECT_NEAR(double(twice.size() - single.size()), particles*3*4.0, 1);
    const auto isFloat = [](double value) { return double(float(value)) == value; };
    const std::vector<double> exact = field("positions");
    EXPECT_LT(std::count_if(exact.begin(), exact.end(), isFloat), long(exact.size()/10));
}

// What it wrote it goes on from to the bit.
TEST_P(Precision, ADoubleRunGoesOnWhereItWasStopped)
{
    control("writeFormat binary; endTime 2e-3;");
    ASSERT_EQ(solve("-precision double").status, 0);
    const std::string whole = read("0.002/liquid/positions");
    remove("0.002");
    const Outcome outcome = solve("-precision double");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_EQ(read("0.002/liquid/positions"), whole);
}

TEST_P(Precision, WhatCannotBeHadIsRefused)
{
    expectRefusal({"-precision", "'half'", "single", "double"}, "-precision half");
    const auto refusalOf = [&](const std::string& command)
    {
        const Outcome outcome = run(command + " -case '" + path().string() + "'");
        EXPECT_EQ(outcome.status, 1) << outcome.text;
        return outcome.text;
    };
    const std::string both = refusalOf(program("pbfDroplet") + " -device cuda --precision=double");
    EXPECT_TRUE(holds(both, {"--> FATAL ERROR", "'cuda'", "'double'", "CPU alone", "-device cpu, or -precision single"}));

    // An installation of which that module was not built.
    const auto there = folder_.path()/"there";
    std::filesystem::create_directories(there/"bin");
    std::filesystem::copy(program("pbfDroplet"), there/"bin");
    const std::string library = environment("SHIZUKU_BUILD") + "/lib";
    const std::string absent = refusalOf("LD_LIBRARY_PATH=" + library + " " + (there/"bin/pbfDroplet").string() + " -precision double");
    EXPECT_TRUE(holds(absent, {"Precision 'double'", "libpbfDroplet-cpuDouble.so is absent", "etc/build -double"}));
}

}
