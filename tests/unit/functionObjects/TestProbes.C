// SPDX-License-Identifier: GPL-3.0-or-later
#include "functionObjects/FunctionObjects.H"

#include "support/FlowCase.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// 12^3 places around the origin, half a spacing off it.
std::vector<Vec3> cube()
{
    std::vector<Vec3> places;
    for (int i = 0; i < 12*12*12; ++i)
    {
        places.push_back({scalar(i % 12) - 5.5f, scalar(i / 12 % 12) - 5.5f, scalar(i / 144) - 5.5f});
    }
    return places;
}

const std::string table = "gauges/0/probes.csv";

std::string probes(const std::string& entries) { return "gauges { type probes; " + entries + " }"; }

}

// A shear u = (z, 2, 0): by symmetry a particle's place has its own velocity exactly, the origin that of z = 0.
TEST(Probes, InterpolateWhatTheParticlesHave)
{
    FlowCase flow(probes("fields (rho U); probeLocations ((0 0 0) (0.5e-3 0.5e-3 1.5e-3) (0 0 6e-3) (0 0 0.1));"));
    const auto places = cube();
    std::vector<Vec3> velocities;
    for (const Vec3& p : places) velocities.push_back({p.z, 2, 0});
    flow.step(places, velocities);
    EXPECT_TRUE(flow.table(table).starts_with
    (
        "time [s],probe,x [m],y [m],z [m],fill,rho [kg/m3],Ux [m/s],Uy [m/s],Uz [m/s]\n0.25,0,0,0,0,"
    ));
    const double u = flow.liquid.units().of(dimensions::velocity);
    const auto value = [&](const std::string& column, int probe) { return flow.value(table, column, probe); };
    EXPECT_NEAR(value("Ux", 0), 0, 1e-5*u);
    EXPECT_NEAR(value("Uy", 0), 2*u, 1e-5*u);
    EXPECT_NEAR(value("Ux", 1), 1.5*u, 1e-5*u);
    EXPECT_NEAR(value("rho", 0), 1000, 0.01);               // the lattice has the rest density
    // At a lattice place the sum is the lattice's own; between eight of them it differs by the kernel's ripple.
    EXPECT_NEAR(value("fill", 1), 1, 1e-5);
    EXPECT_NEAR(value("fill", 0), 1, 0.05);
    EXPECT_NEAR(value("fill", 2), 0.5, 0.05);               // on the face of the cube
    EXPECT_EQ(value("fill", 3), 0);
    EXPECT_TRUE(std::isnan(value("Ux", 3)));
    EXPECT_EQ(flow.table(table).find("-nan"), std::string::npos);
}

TEST(Probes, RefuseBadEntries)
{
    const auto refusal = [](const std::string& entries) { return messageOf([&] { FlowCase flow(probes(entries)); }); };
    EXPECT_TRUE(holds(refusal("fields (U); "), {"'probeLocations' is missing"}));
    EXPECT_TRUE(holds(refusal("probeLocations ((0 0 0));"), {"'fields' is missing"}));
    EXPECT_TRUE(holds(refusal("fields (U); probeLocations ();"), {"no probe"}));
    EXPECT_TRUE(holds(refusal("fields (U); probeLocations (0 0 0);"), {"'probeLocations': found the number 0", "a list of vectors"}));
    EXPECT_TRUE(holds(refusal("fields (U T); probeLocations ((0 0 0));"), {"no field 'T'", "some of the fields below", "rho", "U"}));
    EXPECT_TRUE(holds(refusal("fields (); probeLocations ((0 0 0));"), {"There is no field\n", "rho", "U"}));
    EXPECT_TRUE(holds(refusal("fields (U rho U); probeLocations ((0 0 0));"), {"'U' is named twice", "each once"}));
    EXPECT_TRUE(holds(refusal("fields (p); probeLocations ((0 0 0));"), {"no pressure p", "pbf", "constant/models"}));
}
