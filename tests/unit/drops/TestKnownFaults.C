// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/KnownFaults.H"

#include "core/dictionary/Dictionary.H"
#include "support/ScratchFolder.H"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace shizuku::test
{

namespace
{

constexpr double d = 1e-4;                  // m, spacing

// Solid particles half a spacing behind the surface; places in spacings.
struct Layer : SolidParticles
{
    explicit Layer(const std::string& patch = "block") { patches = {patch}; }

    void add(const Vector3& surface, const Vector3& towardsLiquid)
    {
        positions.push_back(d*(surface - 0.5*towardsLiquid));
        normals.push_back(towardsLiquid);
        patch.push_back(0);
    }
};

// Two faces that open upwards from a line along y by `opening` degrees.
Layer groove(double opening)
{
    Layer layer;
    const double half = 0.5*opening*std::numbers::pi/180;
    for (double y = -5; y <= 5; ++y)
    {
        for (int i = 0; i < 6; ++i)
        {
            for (const double side : {-1.0, 1.0})
            {
                const Vector3 up(side*std::sin(half), 0, std::cos(half));
                layer.add(Vector3(0, y, 0) + (0.25 + i)*up, {-side*std::cos(half), 0, std::sin(half)});
            }
        }
    }
    return layer;
}

// Places of a lattice around the origin, in a box of 16 spacings, that are so [m].
template<class Holds>
std::vector<Vector3> liquidWhere(const Holds& holds)
{
    std::vector<Vector3> places;
    for (double x = -7.5; x < 8; ++x)
    for (double y = -7.5; y < 8; ++y)
    for (double z = -7.5; z < 8; ++z)
    {
        if (holds(Vector3(x, y, z))) places.push_back(d*Vector3(x, y, z));
    }
    return places;
}

std::vector<std::string> said
(
    const SolidParticles& solid, const std::vector<Vector3>& liquid, const std::string& walls = "block { type particles; }",
    const std::string& models = "surfaceTension laplacePressure; bodyForce gravity;"
)
{
    const ScratchFolder folder;
    folder.write("constant/walls", walls);
    folder.write("constant/models", models);
    folder.write("constant/g", "value (0 0 -9.81);");
    std::vector<AnalyticSurface> surfaces;
    if (walls.find("particles") == std::string::npos) surfaces = readAnalyticSurfaces(Dictionary::parse(walls));
    std::vector<std::string> texts;
    for (const Suspect& suspect : knownFaults(folder.path(), solid, surfaces, liquid, d)) texts.push_back(suspect.text);
    return texts;
}

}

TEST(KnownFaults, CornersThatOpenWidelyAreNoGrooves)
{
    EXPECT_GT(findGrooves(groove(50), d).size(), 0u);
    EXPECT_EQ(findGrooves(groove(90), d).size(), 0u);
    EXPECT_EQ(findGrooves(groove(260), d).size(), 0u);      // an edge
}

TEST(KnownFaults, AGrooveCountsWhereLiquidIsInIt)
{
    const auto inside = [](const Vector3& x) { return x.z > 1 && std::abs(x.x) < 0.4*x.z; };
    const auto texts = said(groove(50), liquidWhere(inside));
    ASSERT_EQ(texts.size(), 1u);
    EXPECT_TRUE(holds(texts.front(), {"narrow grooves of 'block'", "Known fault"}));
    EXPECT_TRUE(said(groove(50), liquidWhere([](const Vector3& x) { return x.z > 6; })).empty());
    EXPECT_TRUE(said(groove(50), {}).empty());
    EXPECT_TRUE(said(groove(50), liquidWhere(inside), "block { type particles; }", "surfaceTension none;").empty());
}

TEST(KnownFaults, BoxesWithLiquidInTheirVerticalEdges)
{
    const std::string tank = "tank { type box; min (-8e-4 -8e-4 -8e-4); max (8e-4 8e-4 8e-4); }";
    const auto all = liquidWhere([](const Vector3&) { return true; });
    const auto texts = said(Layer(), all, tank);
    ASSERT_EQ(texts.size(), 1u);
    EXPECT_TRUE(holds(texts.front(), {"vertical edges of the box 'tank'", "two spacings"}));
    EXPECT_TRUE(said(Layer(), liquidWhere([](const Vector3& x) { return std::abs(x.x) < 6; }), tank).empty());
    EXPECT_TRUE(said(Layer(), all, tank, "surfaceTension laplacePressure;").empty());      // no gravity
}

TEST(KnownFaults, GroovesOfALayerAreDescribed)
{
    EXPECT_TRUE(holds(describeGrooves(groove(50), d), {"solid particles, the first at"}));
    EXPECT_EQ(describeGrooves(groove(90), d), "");
}

}
