// SPDX-License-Identifier: GPL-3.0-or-later
// Function objects that look at a drop as a whole, on half a ball of liquid that stands on a plane.

#include "functionObjects/FunctionObjects.H"

#include "motion/ViscousWork.H"
#include "parallel/AllParts.H"
#include "parallel/PartsOfProcess.H"
#include "support/FlowCase.H"

#include <algorithm>
#include <numbers>
#include <utility>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

constexpr double d = 1e-3, radius = 10*d;               // m
constexpr double pi = std::numbers::pi;

// The places of a lattice of spacing 1 in half a ball, the lowest half a spacing above z = 0.
std::vector<Vec3> halfBall(const Vec3& shift = {})
{
    std::vector<Vec3> places;
    for (int x = -10; x < 10; ++x)
    {
        for (int y = -10; y < 10; ++y)
        {
            for (int z = 0; z < 10; ++z)
            {
                const Vec3 p{x + 0.5f, y + 0.5f, z + 0.5f};
                if (squared(p) < 100) places.push_back(p + shift);
            }
        }
    }
    return places;
}

// Free and wetted area of a mesh on the plane z = 0 [m2]: faces that lie within 0.75 spacings of it and look at it by less than 60 degrees off
// are wetted, by what they cover of it.
std::pair<double, double> areasOf(const TriangleMesh& mesh)
{
    double free = 0, wetted = 0;
    for (const auto& [a, b, c] : mesh.faces)
    {
        const Vector3 p = mesh.vertices[a], q = mesh.vertices[b], r = mesh.vertices[c];
        const Vector3 area = 0.5*cross(q - p, r - p);
        const bool wets = (p.z + q.z + r.z)/3 <= 0.75*d && -area.z >= 0.5*length(area);
        (wets ? wetted : free) += wets ? -area.z : length(area);
    }
    return {free, wetted};
}

const CaseText onAPlane
{
    .walls = floorPlane, .wettability = "floor { theta 60; }"
};
const std::string wetting = "surfaceTension Fujisawa2014; wetting contactAngle; bodyForce gravity;";

}

// The lattice fills the half ball to 1 % (2,104 places against 2 pi/3 10^3 = 2,094), and the mesh at the level 1/2 takes
// corners off a rough surface; 4 % of a volume is 0.13 spacings of the radius.
TEST(Volume, IsTheMeshsAndTheParticles)
{
    FlowCase flow("size { type volume; }", onAPlane);
    flow.step(halfBall());
    const std::string table = "size/0/volume.csv";
    EXPECT_TRUE(flow.table(table).starts_with("time [s],volume [m3],particleVolume [m3],crowded [m3],drift [%]\n"));
    const double particles = double(halfBall().size())*d*d*d;
    EXPECT_NEAR(flow.value(table, "particleVolume"), particles, 1e-8*particles);
    EXPECT_NEAR(flow.value(table, "volume"), particles, 0.04*particles);
    EXPECT_NEAR(flow.value(table, "crowded"), particles, 0.01*particles);       // the rest density, but at the plane's edge
    EXPECT_NEAR(flow.value(table, "drift"), 100*(flow.value(table, "volume")/particles - 1), 1e-4);

    FlowCase less("size { type volume; crowded no; }", onAPlane);
    less.step(halfBall());
    EXPECT_TRUE(less.table(table).starts_with("time [s],volume [m3],particleVolume [m3],drift [%]\n"));
    for (const std::string column : {"volume", "drift"}) EXPECT_EQ(less.value(table, column), flow.value(table, column));

    // Three particles on their own.
    auto splashed = halfBall();
    for (const scalar x : {15.0f, 20.0f, 25.0f}) splashed.push_back({x, 0, 5});
    FlowCase spray("size { type volume; spray yes; }", onAPlane);
    spray.step(splashed);
    EXPECT_TRUE(spray.table(table).starts_with("time [s],volume [m3],spray [m3],particleVolume [m3],crowded [m3],drift [%]\n"));
    EXPECT_NEAR(spray.value(table, "spray"), 3*d*d*d, 1e-6*d*d*d);
    EXPECT_EQ(spray.value(table, "volume"), flow.value(table, "volume"));
}

// Of the lattice: from half a spacing to 9.5 of them, written with nine digits.
TEST(BoundingBox, IsThatOfTheParticles)
{
    FlowCase flow("extent { type boundingBox; }", onAPlane);
    flow.step(halfBall({3, 0, 0}));
    const std::string table = "extent/0/boundingBox.csv";
    const std::pair<std::string, double> expected[]
    {
        {"minX", -6.5*d}, {"maxX", 12.5*d}, {"minY", -9.5*d}, {"maxY", 9.5*d}, {"minZ", 0.5*d}, {"maxZ", 9.5*d}
    };
    for (const auto& [column, value] : expected) EXPECT_NEAR(flow.value(table, column), value, 1e-5*d) << column;
}

// Layers of the half ball: as many particles as its lattice has in them, whatever the direction's length.
TEST(CrossSection, IsThatOfTheLayers)
{
    const auto layer = [](int from, int to)
    {
        const auto places = halfBall();
        return double(std::count_if(places.begin(), places.end(), [&](const Vec3& p) { return p.z > from && p.z < to; }));
    };
    const std::string table = "foot/0/crossSection.csv";
    FlowCase thin("foot { type crossSection; normal (0 0 2); places (5.5e-3); }", onAPlane);
    thin.step(halfBall());
    EXPECT_NEAR(thin.value(table, "area"), layer(5, 6)*d*d, 1e-8*d*d);
    EXPECT_NEAR(thin.value(table, "area"), pi*(100 - 5.5*5.5)*d*d, 0.02*pi*100*d*d);
    FlowCase thick("foot { type crossSection; normal (0 0 1); places (2e-3); thickness 4e-3; }", onAPlane);
    thick.step(halfBall());
    EXPECT_NEAR(thick.value(table, "area"), layer(0, 4)/4*d*d, 1e-8*d*d);
    // Of a lattice whose outermost places are a spacing apart.
    EXPECT_NEAR(thin.value(table, "radius"), std::sqrt(100 - 5.5*5.5)*d, 0.1*d);
    FlowCase sparse("foot { type crossSection; normal (0 0 1); places (5.5e-3); }", onAPlane);
    std::vector<Vec3> half;
    for (const Vec3& p : halfBall()) if (std::lround(p.x + p.y + p.z + 100.5) % 2 == 0) half.push_back(p);
    sparse.step(half);
    EXPECT_NEAR(sparse.value(table, "radius"), thin.value(table, "radius"), 0.01*thin.value(table, "radius"));
    FlowCase beside("foot { type crossSection; normal (0 0 1); places (2e-2); }", onAPlane);
    beside.step(halfBall());
    EXPECT_EQ(beside.value(table, "area"), 0);
    EXPECT_EQ(beside.value(table, "radius"), 0);
}

TEST(Energy, IsThatOfTheHalfBall)
{
    FlowCase flow("energies { type energy; } spread { type spreadDiameter; }", onAPlane, wetting);
    const auto places = halfBall({0, 0, 0});
    const double u = flow.liquid.units().of(dimensions::velocity);
    flow.step(places, std::vector<Vec3>(places.size(), Vec3{3, 0, 4}));         // 5 scaled units of speed
    const std::string table = "energies/0/energy.csv";
    const double mass = 1000*double(places.size())*d*d*d;
    double height = 0;
    for (const Vec3& p : places) height += double(p.z)*d/double(places.size());
    EXPECT_NEAR(flow.value(table, "kinetic"), 0.5*mass*25*u*u, 1e-5*mass*25*u*u);               // sums of floats
    EXPECT_NEAR(flow.value(table, "gravitational"), mass*9.81*height, 1e-5*mass*9.81*height);
    // sigma (A - A_wet cos 60) of the mesh: sums of doubles, in the tables' nine digits.
    const auto [free, wetted] = areasOf(flow.view().surface());
    const double surface = 0.072*(free - 0.5*wetted);
    EXPECT_NEAR(flow.value(table, "surface"), surface, 1e-8*surface);
    EXPECT_NEAR(flow.value("spread/0/spreadDiameter.csv", "wettedArea"), wetted, 1e-8*wetted);
    // The ball's and its foot's; the lattice is rough, by 0.1 spacings of its radius.
    EXPECT_NEAR(free, 2*pi*radius*radius, 0.02*2*pi*radius*radius);
    EXPECT_NEAR(wetted, pi*radius*radius, 0.02*pi*radius*radius);
    EXPECT_NEAR(flow.value(table, "wetting"), -0.5*0.072*wetted, 1e-8*0.072*wetted);
    const double total = flow.value(table, "kinetic") + flow.value(table, "gravitational") + flow.value(table, "surface");
    EXPECT_NEAR(flow.value(table, "total"), total, 1e-7*total);
    EXPECT_TRUE(std::isnan(flow.value(table, "viscosity")));        // nobody counts it
}

// Half a ball that speeds up from 2 to 4 units while viscosity takes what a speed of 1 is worth: numerics have made 12/2 + 1/2 of m V u^2. That is told, and goes
// on from a restart.
TEST(Energy, TellsWhatNumericsHaveMade)
{
    FlowCase flow("energies { type energy; mostMade 1e-3; }", onAPlane, "surfaceTension Fujisawa2014; wetting contactAngle;");
    const auto places = halfBall();
    const double u = flow.liquid.units().of(dimensions::velocity), unit = 0.5*1000*double(places.size())*d*d*d*u*u;
    double& taken = flow.liquid.number(ViscousWork::number, 0);
    const std::string table = "energies/0/energy.csv";
    flow.step(places, std::vector<Vec3>(places.size(), Vec3{2, 0, 0}));
    EXPECT_EQ(flow.value(table, "numerics"), 0);
    EXPECT_EQ(flow.report(), "");
    taken = unit;
    flow.step(places, std::vector<Vec3>(places.size(), Vec3{4, 0, 0}));
    EXPECT_NEAR(flow.value(table, "viscosity"), unit, 1e-8*unit);
    // Differences of sums that are some hundred times as large, in the tables' nine digits.
    EXPECT_NEAR(flow.value(table, "numerics"), 13*unit, 1e-5*13*unit);
    const double share = 13*unit/(0.072*areasOf(flow.view().surface()).first);
    EXPECT_EQ(flow.report().find("numerics have made") != std::string::npos, share > 1e-3) << share;
    EXPECT_GT(share, 1e-3);
}

TEST(Energy, OfTheSurfaceIsUnknownWhereTheModelsHaveNoContactAngle)
{
    FlowCase flow("energies { type energy; }", onAPlane, "surfaceTension Akinci2013;");
    flow.step(halfBall());
    EXPECT_TRUE(std::isnan(flow.value("energies/0/energy.csv", "surface")));
    EXPECT_TRUE(holds(flow.table("energies/0/energy.csv"), {"\n0.25,0,0,nan,nan,nan,nan,nan,nan\n"}));       // no weight: 0, not -0
    flow.step(halfBall({0, 0, 5}));             // off the wall: sigma times all of the mesh, in nine digits
    const double surface = 0.072*flow.view().surface().area();
    EXPECT_NEAR(flow.value("energies/0/energy.csv", "surface"), surface, 1e-8*surface);
}

TEST(SpreadDiameter, MeasuresTheFoot)
{
    FlowCase flow("spread { type spreadDiameter; }", onAPlane);
    flow.step(halfBall());
    const std::string table = "spread/0/spreadDiameter.csv";
    EXPECT_TRUE(holds(flow.table(table), {"0.25,floor,0,0,1,", "wettedArea [m2]", "wettedExtent [m]", "liquidExtent [m]"}));
    // The mesh rounds the foot's edge off at half a spacing: of 20 spacings one is missing at most.
    EXPECT_NEAR(flow.value(table, "wettedDiameter"), 2*radius, 1.2*d);
    EXPECT_NEAR(flow.value(table, "wettedExtent"), 2*radius, 1.2*d);
    const double area = flow.value(table, "wettedArea");
    EXPECT_NEAR(flow.value(table, "wettedDiameter"), 2*std::sqrt(area/pi), 1e-8);
    // Particles at the rim, whose centres are in the ball, stand out by up to half a spacing on either side.
    EXPECT_NEAR(flow.value(table, "liquidExtent"), 2*radius, d);
    EXPECT_NEAR(flow.value(table, "height"), radius, 0.5*d);

    flow.step(halfBall({0, 0, 5}));             // it has left the wall
    EXPECT_EQ(flow.value(table, "wettedArea"), 0);
    EXPECT_EQ(flow.value(table, "wettedDiameter"), 0);
    EXPECT_TRUE(std::isnan(flow.value(table, "height")));
}

TEST(SpreadDiameter, TakesOneWallOrEach)
{
    const CaseText tank{.walls = "tank { type box; min (-0.01 -0.01 0); max (0.05 0.05 0.05); } lid { type plane; point (0 0 0.04); normal (0 0 -1); }"};
    FlowCase flow("all { type spreadDiameter; } lid { type spreadDiameter; wall lid; }", tank);
    flow.step(halfBall());
    const std::string table = flow.table("all/0/spreadDiameter.csv");
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 7);
    const std::string lid = flow.table("lid/0/spreadDiameter.csv");
    EXPECT_EQ(std::count(lid.begin(), lid.end(), '\n'), 1 + 1);
    EXPECT_EQ(flow.value("lid/0/spreadDiameter.csv", "wettedArea"), 0);

    const auto refusal = [&](const std::string& entries, const CaseText& text)
    {
        return messageOf([&] { FlowCase("a { type spreadDiameter; " + entries + " }", text); });
    };
    EXPECT_TRUE(holds(refusal("wall flor;", onAPlane), {"'flor'", "Did you mean 'floor'"}));
    EXPECT_TRUE(holds(refusal("", {}), {"no wall", "constant/walls"}));
}

TEST(ContactAngleTable, MeasuresAsProbeAngleDoes)
{
    FlowCase flow("angle { type contactAngle; }", onAPlane, wetting);
    flow.step(halfBall());
    const std::string table = "angle/0/contactAngle.csv";
    EXPECT_TRUE(holds(flow.table(table), {"time [s],drop,state,prescribed [deg],angle [deg]", "attached"}));
    EXPECT_NEAR(flow.value(table, "angle"), 90, 3);         // of a lattice's ball with steps of one spacing in ten
    EXPECT_EQ(flow.value(table, "prescribed"), 60);
    EXPECT_EQ(flow.value(table, "particles"), double(halfBall().size()));
    EXPECT_NEAR(flow.value(table, "contactRadius"), radius, 0.5*d);

    const auto refusal = [&](const std::string& entries, const CaseText& text)
    {
        return messageOf([&] { FlowCase("a { type contactAngle; " + entries + " }", text); });
    };
    EXPECT_TRUE(holds(refusal("wall flor;", onAPlane), {"'flor'", "floor"}));
    EXPECT_TRUE(holds(refusal("", {}), {"'wall' is missing"}));
}

// On a wall that holds lines, whose whole line has the advancing angle, and before a step has given it one.
TEST(ContactAngleTable, TellsWhatTheLineDoes)
{
    FlowCase flow
    (
        "angle { type contactAngle; }", {.walls = floorPlane, .wettability = "floor { law hysteresis; thetaAdv 100; thetaRec 60; }"},
        "pressure completedPbf; surfaceTension laplacePressure; wetting extendedSurface;"
    );
    flow.step(halfBall());
    const std::string table = "angle/0/contactAngle.csv";
    EXPECT_TRUE(std::isnan(flow.value(table, "lineHeld")));
    auto& angles = std::get<Buffer<scalar>>(flow.liquid.fields().find("contactLineAngle")->values);
    angles.upload(std::vector<scalar>(angles.size(), scalar(100*pi/180)));
    flow.measure();
    EXPECT_EQ(flow.value(table, "lineAdvancing"), 100);
    EXPECT_EQ(flow.value(table, "lineHeld"), 0);
    EXPECT_NEAR(flow.value(table, "localAngle"), 100, 1e-4);        // of a float's radians
    EXPECT_TRUE(std::isnan(flow.value(table, "prescribed")));
}

// Nobody asks: no surface, no density, no sums.
TEST(FlowView, ComputesNothingUnasked)
{
    FlowCase flow("timing { type stepTime; }", onAPlane);
    const auto places = halfBall();
    flow.place(places);
    const long before = deviceCounters().launches;
    flow.place(places);
    const long placing = deviceCounters().launches - before;
    flow.step(places);
    EXPECT_EQ(deviceCounters().launches - before, 2*placing);
    // One surface for all who ask in a step.
    FlowCase many("a { type volume; } b { type spreadDiameter; } c { type contactAngle; }", onAPlane);
    FlowCase one("a { type volume; }", onAPlane);
    const auto launchesOf = [&](FlowCase& flow)
    {
        const long start = deviceCounters().launches;
        flow.step(places);
        return deviceCounters().launches - start;
    };
    EXPECT_EQ(launchesOf(many), launchesOf(one));
}

// Each part makes a piece, of which part 0 has the whole; roundings differ.
TEST(FlowView, OfPartsHasTheSurfaceThatOneMakes)
{
    std::vector<Vec3> places = halfBall();
    places.push_back({0.5f, 0.5f, 30});                         // spray
    FlowCase whole("", onAPlane);
    whole.place(places);
    const TriangleMesh expected = whole.view().surface();
    for (const int parts : {1, 2, 3})
    {
        runParts(parts, [&](const Communicator& all)
        {
            const auto [first, end] = shareOf(all, places.size());
            FlowCase flow("", onAPlane);
            flow.place({places.begin() + long(first), places.begin() + long(end)});
            flow.liquid.ghosts().join(all);
            FlowView& view = flow.view();
            view.cut(nullptr, false, 0);
            view.gatherSurface(true);
            if (all.part() > 0) return;
            EXPECT_EQ(view.surface().faces, expected.faces) << parts;
            EXPECT_NEAR(view.surfaceVolume(), whole.view().surfaceVolume(), 1e-6*expected.volume()) << parts;
            EXPECT_EQ(view.particlesOutsideSurface(), whole.view().particlesOutsideSurface()) << parts;
        });
    }
    EXPECT_EQ(whole.view().particlesOutsideSurface(), 1);
}

// Each part measures its piece, and what they add up is what one process measures: sums of some thousand faces in another order.
TEST(FlowView, PiecesOfPartsAreMeasuredTogether)
{
    const std::string functions = "wet { type spreadDiameter; } e { type energy; } angle { type contactAngle; }";
    const std::vector<Vec3> places = halfBall();
    FlowCase whole(functions, onAPlane, wetting);
    whole.step(places);
    EXPECT_GT(whole.value("angle/0/contactAngle.csv", "particles"), 0.9*double(places.size()));
    for (const int parts : {2, 3})
    {
        runParts(parts, [&](const Communicator& all)
        {
            const auto [first, end] = shareOf(all, places.size());
            FlowCase flow(functions, onAPlane, wetting);
            flow.place({places.begin() + long(first), places.begin() + long(end)});
            flow.liquid.ghosts().join(all);
            flow.view().cut(nullptr, false, 0);
            flow.measure();
            if (all.part() > 0)
            {
                EXPECT_EQ(flow.table("wet/0/spreadDiameter.csv"), "");
                return;
            }
            for (const char* const column : {"wettedArea", "wettedDiameter", "wettedExtent", "liquidExtent", "height"})
            {
                const double expected = whole.value("wet/0/spreadDiameter.csv", column);
                EXPECT_NEAR(flow.value("wet/0/spreadDiameter.csv", column), expected, 1e-6*expected) << column << ' ' << parts;
            }
            const double surface = whole.value("e/0/energy.csv", "surface");
            EXPECT_GT(surface, 0);
            EXPECT_NEAR(flow.value("e/0/energy.csv", "surface"), surface, 1e-6*surface) << parts;
            const auto ofDrop = [](const FlowCase& from, const char* column) { return from.value("angle/0/contactAngle.csv", column); };
            EXPECT_EQ(ofDrop(flow, "particles"), ofDrop(whole, "particles")) << parts;
            EXPECT_NEAR(ofDrop(flow, "angle"), ofDrop(whole, "angle"), 1e-3) << parts;
        });
    }
}
