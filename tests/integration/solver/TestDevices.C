// SPDX-License-Identifier: GPL-3.0-or-later
// The CPU and the GPU compute the same: one step of the solver and a mesh, each to the rounding of floats.

#include "SolverCase.H"

#include "core/fieldFile/FieldFile.H"
#include "meshes/PlyFile.H"

#include <cmath>

namespace shizuku::test
{

namespace
{

class Devices : public SolverCase
{
protected:
    // Largest difference of the vectors of two time folders, particle by particle.
    static double difference(const std::filesystem::path& a, const std::filesystem::path& b, const std::string& field)
    {
        const auto inOrder = [&](const std::filesystem::path& folder)
        {
            const FieldData id = readField(folder/"liquid/id"), values = readField(folder/"liquid"/field);
            std::vector<Vector3> result(id.elements());
            for (std::size_t i = 0; i < result.size(); ++i)
            {
                result[std::size_t(id(i))] = {values(i, 0), values(i, 1), values(i, 2)};
            }
            return result;
        };
        const auto first = inOrder(a), second = inOrder(b);
        EXPECT_EQ(first.size(), std::size_t(particles));
        double most = 0;
        for (std::size_t i = 0; i < first.size(); ++i) most = std::max(most, length(first[i] - second[i]));
        return most;
    }

    Outcome on(const std::string& device, const std::string& application) const
    {
        return run(program(application) + " -device " + device + " -case " + path().string());
    }
};

std::vector<std::string> devicesBesideTheCpu()
{
    std::vector<std::string> result = devices();
    std::erase(result, "cpu");
    return result;
}

INSTANTIATE_TEST_SUITE_P(BesideTheCpu, Devices, testing::ValuesIn(devicesBesideTheCpu()));

}

TEST_P(Devices, AgreeOnOneStep)
{
    fill({0.2, 0, -0.3});
    // A fixed number of iterations: a threshold that one device just misses would not be rounding.
    write("system/solution", "spacing 1e-3;\npressure { minIterations 4; maxIterations 4; tolerance 0; }\n");
    const double dt = 2e-4;
    control("adjustTimeStep no; deltaT 2e-4; endTime 2e-4; writeFormat binary;");
    ASSERT_EQ(on("cpu", "pbfDroplet").status, 0);
    std::filesystem::rename(path()/"0.0002", folder_.path()/"cpu");
    const Outcome outcome = on(device(), "pbfDroplet");
    ASSERT_EQ(outcome.status, 0) << outcome.text;

    // Positions are sums of some dozens of floats of a few spacings: an ulp at 4 spacings is 4.8e-7 of a spacing,
    // sums are made in another order and with other fused operations, and four iterations add up what each leaves.
    const double tolerance = 1e-5*spacing;
    EXPECT_LT(difference(folder_.path()/"cpu", path()/"0.0002", "positions"), tolerance);
    EXPECT_LT(difference(folder_.path()/"cpu", path()/"0.0002", "U"), 2*tolerance/dt);      // both ends of the step
    // Not because nothing has moved.
    const FieldData U = readField(path()/"0.0002/liquid/U");
    double fastest = 0;
    for (std::size_t i = 0; i < U.elements(); ++i) fastest = std::max(fastest, std::abs(U(i, 2)));
    EXPECT_GT(fastest, 0.1);
}

TEST_P(Devices, AgreeOnTheSurface)
{
    ASSERT_EQ(on("cpu", "meshSurface").status, 0);
    const TriangleMesh first = readPly(path()/"0/surface/liquid.ply");
    remove("0/surface");
    ASSERT_EQ(on(device(), "meshSurface").status, 0);
    const TriangleMesh second = readPly(path()/"0/surface/liquid.ply");
    EXPECT_EQ(first.faces.size(), second.faces.size());
    EXPECT_NEAR(first.volume(), second.volume(), 1e-5*first.volume());      // vertices to a few ulps of six digits
}

}
