// SPDX-License-Identifier: GPL-3.0-or-later
// What compareReference takes from probeAngle's table: which drop of which times, and how films and drops off the wall count.

#include "DropCase.H"
#include "caseFiles/LiquidFiles.H"
#include "support/DropMeshes.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shizuku::test
{

namespace
{

// A case with a small and a large drop, whose table is written by hand: the number of particles alone is taken from the files.
class CompareReference : public DropCase
{
protected:
    void SetUp() override
    {
        DropCase::SetUp();
        write("constant/liquidProperties", "rho 998; nu 1e-6; sigma 0.0728;\n");
        write("constant/models", "bodyForce gravity;\n");
        write("constant/g", "value (0 0 -9.81);\n");
        writeTime("0", {drop(60)}, false);
    }

    // Rows of time, state, angle, volume; the drop's other numbers are those of its row, 1 + row.
    void writeDrops(const std::vector<std::string>& rows) const
    {
        std::string text = "time [s],state,angle [deg],volume [m3],height [m],contactRadius [m],tangentMean [deg]\n";
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            const std::string own = std::to_string(1 + i);
            text += rows[i] + "," + own + "," + own + "," + own + "\n";
        }
        write("postProcessing/probeAngle/0/angle.csv", text);
    }

    Outcome compare(const std::string& comparison) const
    {
        write("system/compareReferenceDict", "comparisons { drop { " + comparison + " } }\n");
        return call("compareReference");
    }

    // Measured numbers by their quantities.
    std::map<std::string, double> measured(const std::string& comparison) const
    {
        const Outcome outcome = compare(comparison);
        EXPECT_EQ(outcome.status, 0) << outcome.text;
        std::map<std::string, double> numbers;
        for (const auto& row : table("postProcessing/compareReference/comparison.csv"))
        {
            numbers[row.at("quantity")] = number(row.at("measured"));
        }
        return numbers;
    }
};

const std::vector<std::string> fourTimes
{
    "0,attached,10,2", "0.1,attached,99,1", "0.1,attached,50,3", "0.2,film,nan,3", "0.2,attached,98,2", "0.3,attached,64,3", "0.3,attached,97,1"
};

// The largest drop's angles: 10, 50, 0 (a film), 64.
TEST_F(CompareReference, TakesTheLargestDropOfEachTime)
{
    writeDrops(fourTimes);
    const auto cap = measured("type contactAngle; theta 60; within 3;");
    EXPECT_DOUBLE_EQ(cap.at("contact angle"), 38);                      // of the last three
    EXPECT_DOUBLE_EQ(cap.at("range of the last angles"), 64);
    EXPECT_EQ(cap.at("height"), 6);                                     // of the last row's but one
    EXPECT_DOUBLE_EQ(measured("type contactAngle; theta 60; within 3; times 9;").at("contact angle"), 31);
    EXPECT_TRUE(holds(compare("type contactAngle; theta 60; within 3;").text, {"at most 3: miss"}));
    EXPECT_FALSE(holds(compare("type contactAngle; theta 60;").text, {"at most"}));       // told, not judged

    EXPECT_EQ(measured("type angleOnSphere; theta 60; within 3;").at("contact angle"), 64);
    EXPECT_EQ(measured("type angleOnSphere; theta 60; within 3;").at("angle along the contact line"), 6);
}

TEST_F(CompareReference, FilmsAndDropsOffTheWall)
{
    writeDrops(fourTimes);
    const auto film = measured("type contactAngle; theta 0; within 3;");
    EXPECT_EQ(film.at("pieces of the film"), 2);
    EXPECT_NEAR(film.at("height of the film"), 6/spacing, 1e-3);        // 46875, written with nine digits
    EXPECT_EQ(measured("type contactAngle; theta 180; within 3;").at("off the wall"), 0);
    writeDrops({"0,attached,10,2", "0.1,attached,170,1", "0.1,detached,nan,2"});
    EXPECT_EQ(measured("type contactAngle; theta 180; within 3;").at("off the wall"), 1);
    EXPECT_DOUBLE_EQ(measured("type contactAngle; theta 90; within 3;").at("contact angle"), 95);      // of 10 and 180
}

// A puddle of three layers, whose rim bends within as many: tangents would have its contact radius several per cent too large.
TEST_F(CompareReference, AnExactPuddleHasItsHeightRadiusAngleAndTension)
{
    const double volume = double(readLiquidPositions(path()/"0").size())*std::pow(spacing, 3);
    const double R = std::cbrt(3*volume/(4*std::numbers::pi)), bond = 4;
    write("constant/g", "value (0 0 -" + std::to_string(0.0728*bond/(998*R*R)) + ");\n");
    const DropProfile exact = bashforthAdamsOfVolume(volume, R/std::sqrt(bond), 60, 101);
    std::filesystem::create_directories(path()/"0/surface");
    writePly(path()/"0/surface/liquid.ply", revolvedMesh(exact, 0.5*spacing));
    ASSERT_EQ(call("probeAngle").status, 0);
    const auto found = measured("type gravityDrop; theta 60; within 2;");
    // The mesh's cells, half a spacing, have a sagitta of 0.01 spacings on this rim: 0.3 % of the height, 0.1 of the radius.
    EXPECT_NEAR(found.at("height")/exact.height(), 1, 0.005);
    EXPECT_NEAR(found.at("contact radius")/exact.contactRadius(), 1, 0.002);
    EXPECT_NEAR(found.at("contact angle by the profile"), 60, 0.5);
    EXPECT_NEAR(found.at("surface tension")/0.0728, 1, 0.01);
    EXPECT_GT(number(table("postProcessing/probeAngle/0/angle.csv").at(0).at("lineRadius"))/exact.contactRadius(), 1.03);
}

TEST_F(CompareReference, ATableWithoutDropsIsRefused)
{
    writeDrops({});
    for (const std::string type : {"contactAngle", "angleOnSphere", "gravityDrop"})
    {
        const Outcome outcome = compare("type " + type + "; theta 60; within 3;");
        EXPECT_EQ(outcome.status, 1) << type;
        EXPECT_TRUE(holds(outcome.text, {"probeAngle found no drop"})) << type << outcome.text;
    }
}

}

}
