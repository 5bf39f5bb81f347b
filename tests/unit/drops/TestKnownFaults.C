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

// Two faces that meet along y, each 6 spacings wide: the top z = 0, x < 0, and a side that is turned from it by `turn` degrees. The edge is rounded with that radius.
Layer edge(double turn, double radius)
{
    Layer layer;
    const double angle = turn*std::numbers::pi/180, back = radius*std::tan(angle/2);
    const Vector3 centre(-back, 0, -radius), normal(std::sin(angle), 0, std::cos(angle)), down(std::cos(angle), 0, -std::sin(angle));
    const int arc = int(std::ceil(angle*std::max(radius - 0.5, 0.0)));
    for (double y = -5; y <= 5; ++y)
    {
        const Vector3 along(0, y, 0);
        for (int i = 0; i < 6; ++i)
        {
            layer.add(along + Vector3(-back - 0.5 - i, 0, 0), {0, 0, 1});
            layer.add(along + (back + 0.5 + i)*down, normal);
        }
        for (int i = 0; i < arc; ++i)
        {
            const double at = angle*(i + 0.5)/arc;
            const Vector3 outwards(std::sin(at), 0, std::cos(at));
            layer.add(along + centre + radius*outwards, outwards);
        }
    }
    return layer;
}

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

std::size_t count(const SolidParticles& solid, SharpPair::Kind kind)
{
    std::size_t number = 0;
    for (const SharpPair& place : findSharpPairs(solid, d)) number += place.kind == kind;
    return number;
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

constexpr auto edgeOf = SharpPair::Kind::edge;
constexpr auto grooveOf = SharpPair::Kind::groove;

}

// Both layers meet in a row of 11 particles of each face. The next row of each face is a spacing away from it, and counts too.
TEST(KnownFaults, EdgesAreSharpBelowTheRadiusThatIsCalm)
{
    EXPECT_EQ(count(edge(90, 0), edgeOf), 44u);
    EXPECT_GT(count(edge(120, 0), edgeOf), 0u);
    EXPECT_EQ(count(edge(45, 0), edgeOf), 0u);
    EXPECT_GT(count(edge(90, 0.5), edgeOf), 0u);
    EXPECT_EQ(count(edge(90, 1.5), edgeOf), 0u);
    EXPECT_EQ(count(edge(90, 2), edgeOf), 0u);
    EXPECT_EQ(count(edge(0, 0), edgeOf), 0u);
    EXPECT_EQ(count(edge(90, 0), grooveOf), 0u);
}

TEST(KnownFaults, CornersThatOpenWidelyAreNoGrooves)
{
    EXPECT_GT(count(groove(50), grooveOf), 0u);
    EXPECT_EQ(count(groove(90), grooveOf), 0u);
    EXPECT_EQ(count(groove(50), edgeOf), 0u);
}

TEST(KnownFaults, AnEdgeCountsWhereLiquidIsOnBothOfItsSides)
{
    const auto outside = [](const Vector3& x) { return x.x > 0 || x.z > 0; };
    const auto above = [](const Vector3& x) { return x.x < 0 && x.z > 0; };
    const auto texts = said(edge(90, 0), liquidWhere(outside));
    ASSERT_EQ(texts.size(), 1u);
    EXPECT_TRUE(holds(texts.front(), {"surrounds sharp edges of 'block' (44 solid particles", "Known fault", "rounded by two spacings"}));
    EXPECT_TRUE(said(edge(90, 0), liquidWhere(above)).empty());         // a drop that ends at the edge
    EXPECT_TRUE(said(edge(90, 2), liquidWhere(outside)).empty());
    EXPECT_TRUE(said(edge(90, 0), {}).empty());
    EXPECT_TRUE(said(edge(90, 0), liquidWhere(outside), "block { type particles; }", "surfaceTension none;").empty());
}

TEST(KnownFaults, AGrooveCountsWhereLiquidIsInIt)
{
    const auto inside = [](const Vector3& x) { return x.z > 1 && std::abs(x.x) < 0.4*x.z; };
    const auto texts = said(groove(50), liquidWhere(inside));
    ASSERT_EQ(texts.size(), 1u);
    EXPECT_TRUE(holds(texts.front(), {"narrow grooves of 'block'", "Known fault"}));
    EXPECT_TRUE(said(groove(50), liquidWhere([](const Vector3& x) { return x.z > 6; })).empty());
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

TEST(KnownFaults, SharpPlacesOfALayerAreDescribed)
{
    EXPECT_TRUE(holds(describeSharpPlaces(edge(90, 0), d), {"44 solid particles, the first at"}));
    EXPECT_EQ(describeSharpPlaces(edge(90, 2), d), "");
}

}
