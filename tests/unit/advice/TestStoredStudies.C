// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/angles/Degrees.H"
#include "unit/advice/FakeStudies.H"

#include <cmath>

namespace shizuku::test
{

namespace
{

constexpr double digits = 1e-12;        // doubles

using StoredStudiesTest = FakeStudies;

TEST_F(StoredStudiesTest, ErrorsAreMeansOfTheRunsAround)
{
    const auto error = [&](double theta, double n, double steps)
    {
        return studies_->error("sessile", theta, "default", n, steps)->value;
    };
    // By hand at a run: the next ones are two factors of two away in the step (exp(-2)), 8.78 of 1.3 in the particles (exp(-38.5)),
    // with their own step exp(-40.5) and that of 5 exp(-42.5), and four times 15 degrees (exp(-8)). Their errors count 10^(1/3) times.
    const auto p = [](double number) { return std::pow(number, 1.5); };
    const double e2 = std::exp(-2), particles = std::exp(-0.5*std::pow(std::log(10)/std::log(1.3), 2)), five = std::exp(-0.5*std::pow(std::log2(5/0.7), 2));
    EXPECT_NEAR
    (
        error(60, 1000, 0.7),
        std::pow
        (
            (p(0.1) + p(0.2)*e2 + std::sqrt(10)*particles*(p(0.01) + p(0.02)*e2 + p(0.03)*five) + p(0.05)*std::exp(-8))
                /(1 + e2 + particles*(1 + e2 + five) + std::exp(-8)),
            1/1.5
        ),
        digits
    );
    for (const double theta : {60.0, 90.0, 117.0})
    {
        for (const double n : {1000.0, 2000.0, 10000.0})
        {
            for (const double steps : {0.7, 1.4}) EXPECT_NEAR(error(theta, n, steps), typical(theta, n, steps), digits);
            // A step that only the finest runs have tried.
            EXPECT_NEAR(error(theta, n, 5), typical(60, 10000, 5), digits);
        }
    }
    // With spacings 1.1 times smaller; the fine ones weigh 3e-13.
    EXPECT_NEAR(error(60, 1331, 0.7), error(60, 1000, 0.7)/1.1, 1e-9);
    // Beyond the runs as at their ends.
    EXPECT_NEAR(error(60, 100, 0.7), error(60, 1000, 0.7), digits);
    EXPECT_NEAR(error(60, 1e6, 0.7), error(60, 10000, 0.7), digits);
    EXPECT_NEAR(error(20, 1000, 0.7), error(60, 1000, 0.7), digits);
    // Sources are those of a tenth of the weight; at 3000 the fine ones have exp(-10.5) beside exp(-8.8).
    EXPECT_EQ(studies_->error("sessile", 60, "default", 3000, 0.7)->source, "coarse and fine");
    EXPECT_EQ(studies_->error("sessile", 60, "default", 1000, 0.7)->source, "coarse");
}

// As much of the tube's radius at all angles.
TEST_F(StoredStudiesTest, ErrorsOfMenisciGrowAsTheirRiseFalls)
{
    const auto error = [&](double theta) { return studies_->error("meniscus", theta, "default", 1000, 0.7)->value; };
    const auto rise = [](double theta) { return std::abs(std::tan(radians(45 - theta/2))); };
    for (const double theta : {10.0, 30.0, 75.0, 120.0, 170.0}) EXPECT_NEAR(error(theta), 0.05*rise(30)/rise(theta), digits);
    EXPECT_FALSE(studies_->error("meniscus", 90, "default", 1000, 0.7));
}

TEST_F(StoredStudiesTest, WhatWasNotRunIsNotKnown)
{
    EXPECT_FALSE(studies_->error("splash", 0, "default", 1000, 0.7));
    EXPECT_FALSE(studies_->error("sessile", 60, "unheardOf", 1000, 0.7));
    EXPECT_FALSE(studies_->error("sessile", 60, "default", 1000, 10));
    EXPECT_FALSE(studies_->calmSteps("other"));
    EXPECT_DOUBLE_EQ(studies_->calmSteps("default")->value, 3);
}

TEST_F(StoredStudiesTest, ModelSetsAreFoundByTheirModels)
{
    EXPECT_EQ(studies_->modelSet("pbf", "Fujisawa2014", "contactAngle")->name, "other");
    EXPECT_EQ(studies_->modelSet("completedPbf", "laplacePressure", "none")->name, "default");
    EXPECT_FALSE(studies_->modelSet("pbf", "laplacePressure", "extendedSurface"));
}

TEST_F(StoredStudiesTest, TimesOfASubStep)
{
    const auto seconds = [&](const char* backend, const char* device, double n)
    {
        return studies_->stepTime(backend, device, n)->value;
    };
    EXPECT_NEAR(seconds("cuda", "A GPU", 10000), 2e-3, digits);            // the middle of both axes
    EXPECT_NEAR(seconds("cuda", "A GPU", 10), 1e-3, digits);
    EXPECT_NEAR(seconds("cuda", "A GPU", 1e6), 4e-2, digits);              // ten times the largest one
    EXPECT_NEAR(seconds("cpu", "A CPU", 100), 1e-3, digits);
    EXPECT_EQ(studies_->stepTime("cpu", "another one", 1000)->source, "measured on A CPU: two");
    EXPECT_FALSE(studies_->stepTime("abacus", "A CPU", 1000));
}

// Half of the runs are three times what their partners foretell.
TEST_F(StoredStudiesTest, ScatterIsWhatNineOfTenStayBelow)
{
    EXPECT_NEAR(*inPairs(15, 3).scatter("default"), 3, digits);
    EXPECT_NEAR(*inPairs(15, 1).scatter("default"), 1, digits);
    EXPECT_FALSE(inPairs(9, 3).scatter("default"));            // too few
    EXPECT_FALSE(studies_->scatter("other"));
}

// What the repository ships: the tables are whole, and tell of the default.
TEST(ShippedStudies, TellOfTheDefault)
{
    setenv("HOME", "/nonexistent", 1);
    const StoredStudies studies;
    const std::vector<std::pair<std::string, double>> scenes
    {
        {"sessile", 60}, {"gravity", 1}, {"oscillation", 0}, {"volume", 0}, {"analyticWall", 60}
    };
    for (const auto& [scene, parameter] : scenes)
    {
        const auto error = studies.error(scene, parameter, "default", 3000, 0.7);
        ASSERT_TRUE(error) << scene;
        EXPECT_GT(error->value, 0) << scene;
        EXPECT_LT(error->value, 0.5) << scene;
        EXPECT_NE(error->source.find("doc/"), std::string::npos) << scene;
    }
    EXPECT_GT(*studies.scatter("default"), 1);
    EXPECT_LT(*studies.scatter("default"), 3);
    EXPECT_TRUE(studies.calmSteps("default"));
    EXPECT_TRUE(studies.stepTime("cuda", "NVIDIA H100 80GB HBM3", 20000));
    EXPECT_TRUE(studies.stepTime("cpu", "any", 20000));
}

}

}
