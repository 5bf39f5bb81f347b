#include "unit/advice/FakeStudies.H"

#include <cmath>

namespace shizuku::test
{

namespace
{

constexpr double digits = 1e-12;        // doubles

using StoredStudiesTest = FakeStudies;

TEST_F(StoredStudiesTest, errorsLieBetweenRuns)
{
    const auto error = [&](double theta, double n, double steps)
    {
        return studies_->error("sessile", theta, "default", n, steps)->value;
    };
    EXPECT_NEAR(error(60, 1000, 0.7), 0.1, digits);
    EXPECT_NEAR(error(90, 1000, 0.7), 0.075, digits);              // halfway between 60 and 120 degrees
    EXPECT_NEAR(error(60, 2000, 0.7), 0.05, digits);               // on logarithmic axes: error ~ 1/N
    EXPECT_NEAR(error(60, 10000, 1.4), 0.01*std::sqrt(2), digits); // error ~ sqrt(step)
    // Beyond the runs as at their ends.
    EXPECT_NEAR(error(60, 100, 0.7), 0.1, digits);
    EXPECT_NEAR(error(60, 1e6, 0.7), 0.01, digits);
    // A step that only the finer runs have tried.
    EXPECT_NEAR(error(60, 1000, 5), 0.03, digits);
    EXPECT_EQ(studies_->error("sessile", 60, "default", 2000, 0.7)->source, "coarse and fine");
}

TEST_F(StoredStudiesTest, whatWasNotRunIsNotKnown)
{
    EXPECT_FALSE(studies_->error("splash", 0, "default", 1000, 0.7));
    EXPECT_FALSE(studies_->error("sessile", 60, "unheardOf", 1000, 0.7));
    EXPECT_FALSE(studies_->error("sessile", 60, "default", 1000, 10));
    EXPECT_FALSE(studies_->calmSteps("other"));
    EXPECT_DOUBLE_EQ(studies_->calmSteps("default")->value, 3);
}

TEST_F(StoredStudiesTest, modelSetsAreFoundByTheirModels)
{
    EXPECT_EQ(studies_->modelSet("pbf", "Fujisawa2014", "contactAngle")->name, "other");
    EXPECT_EQ(studies_->modelSet("completedPbf", "continuumSurfaceForce", "none")->name, "default");
    EXPECT_FALSE(studies_->modelSet("pbf", "continuumSurfaceForce", "extendedSurface"));
}

TEST_F(StoredStudiesTest, timesOfASubStep)
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

// What the repository ships: the tables are whole, and tell of the default.
TEST(ShippedStudies, tellOfTheDefault)
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
    EXPECT_TRUE(studies.calmSteps("default"));
    EXPECT_TRUE(studies.stepTime("cuda", "NVIDIA H200", 20000));
    EXPECT_TRUE(studies.stepTime("cpu", "any", 20000));
}

}

}
