// SPDX-License-Identifier: GPL-3.0-or-later
#include "SolverCase.H"

#include "caseFiles/SolidParticles.H"
#include "caseFiles/VectorField.H"
#include "core/fieldFile/FieldFile.H"

#include <dlfcn.h>

#include <fstream>
#include <regex>

namespace shizuku::test
{

namespace fs = std::filesystem;

namespace
{

bool gpuAnswers()
{
    void* const driver = dlopen("libcuda.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!driver) return false;
    const auto init = reinterpret_cast<int (*)(unsigned)>(dlsym(driver, "cuInit"));
    const auto count = reinterpret_cast<int (*)(int*)>(dlsym(driver, "cuDeviceGetCount"));
    int devices = 0;
    return init && count && init(0) == 0 && count(&devices) == 0 && devices > 0;
}

std::vector<double> inRow(int n, double start)
{
    std::vector<double> places;
    for (int i = 0; i < n; ++i) places.push_back(start + i);
    return places;
}

}

std::vector<std::string> devices()
{
    std::vector<std::string> result{"cpu"};
    if (SHIZUKU_WITH_CUDA && gpuAnswers()) result.push_back("cuda");
    return result;
}

SolverCase::SolverCase()
{
    // Threads that wait by spinning take each other's core where other tests run beside this one.
    setenv("OMP_WAIT_POLICY", "passive", 1);
    control();
    write("system/solution", "spacing 1e-3;\npressure { maxIterations 6; }\n");
    write("constant/liquidProperties", "rho 998;\nnu 1e-6;\nsigma 0.0728;\n");
    write
    (
        "constant/models",
        "pressure pbf;\nsurfaceTension Fujisawa2014;\nwetting contactAngle;\nviscosity XSPH;\nbodyForce gravity;\n"
    );
    write("constant/g", "value (0 0 -9.81);\n");
    write
    (
        "constant/walls",
        "floor { type particles; surface \"floor.stl\"; }\nside { type plane; point (-3.5e-3 0 0); normal (1 0 0); }\n"
    );
    write("constant/wettability", "floor { theta 60; }\nside { theta 90; }\n");
    fill({0, 0, 0});

    SolidParticles solid;
    solid.patches = {"floor"};
    for (const double x : inRow(18, -8.5))
    {
        for (const double y : inRow(18, -8.5)) solid.positions.push_back(spacing*Vector3(x, y, -0.5));
    }
    solid.normals.assign(solids, {0, 0, 1});
    solid.patch.assign(solids, 0);
    writeSolidParticles(path(), solid, {});
    const std::vector theta(solids, 60.0);
    writeField(path()/"0/solid/theta", {"theta", FieldType::scalar, dimensions::none, false, theta}, {});
}

void SolverCase::control(const std::string& more) const
{
    // At once, as an editor does: a solver that runs may read it at any time.
    write
    (
        "system/controlDict.new",
        "application pbfDroplet;\nstartFrom latestTime;\nendTime 4e-3;\ndeltaT 1e-3;\nwriteInterval 1;\nreportInterval 1;\n" + more + "\n"
    );
    fs::rename(path()/"system/controlDict.new", path()/"system/controlDict");
}

void SolverCase::fill(const std::array<double, 3>& velocity) const
{
    std::vector<Vector3> positions, velocities;
    for (const double x : inRow(7, -3))
    {
        for (const double y : inRow(7, -3))
        {
            for (const double z : inRow(6, 0.5))
            {
                positions.push_back(spacing*Vector3(x, y, z));
                velocities.push_back(Vector3(velocity[0], velocity[1], velocity[2]) + 1e-3*Vector3(y, z, x));
            }
        }
    }
    writeField(path()/"0/liquid/positions", toField("positions", dimensions::length, positions), {});
    writeField(path()/"0/liquid/U", toField("U", dimensions::velocity, velocities), {});
}

void SolverCase::dropBall() const
{
    write("constant/models", "pressure completedPbf;\nsurfaceTension laplacePressure;\nwetting extendedSurface;\nviscosity newtonian;\nbodyForce gravity;\n");
    write
    (
        "constant/walls",
        "floor { type plane; point (0 0 0); normal (0 0 1); }\nball\n{\n    type sphere; centre (0.5e-3 0 8.6e-3); radius 2e-3; liquid outside;\n"
        "    motion { type sixDoF; mass 1e-5; momentOfInertia 1.6e-11; centreOfMass (0.5e-3 0 8.6e-3); velocity (0 0 -0.3); omega (10 20 30); }\n}\n"
    );
    write("constant/wettability", "floor { theta 60; }\nball { theta 90; }\n");
}

std::string SolverCase::command(const std::string& application, const std::string& arguments) const
{
    return program(application) + " -case '" + path().string() + "' -device " + device() + " " + arguments;
}

Outcome SolverCase::solve(const std::string& arguments) const
{
    return call("pbfDroplet", arguments);
}

Outcome SolverCase::call(const std::string& application, const std::string& arguments) const
{
    return run(command(application, arguments));
}

void SolverCase::expectRefusal
(
    const std::vector<std::string>& parts, const std::string& arguments, const std::string& before,
    const std::string& application
) const
{
    const Contents kept = contents();
    const Outcome outcome = run(before + " " + command(application, arguments));
    EXPECT_EQ(outcome.status, 1) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, parts));
    EXPECT_TRUE(holds(outcome.text, {"--> FATAL", application + ": stopped\n"}));
    EXPECT_EQ(outcome.text.find("\nEnd\n"), std::string::npos) << outcome.text;
    EXPECT_TRUE(same(kept, contents()));
}

SolverCase::Contents SolverCase::contents(const std::string& relative) const
{
    Contents result;
    for (const auto& entry : fs::recursive_directory_iterator(path()/relative))
    {
        const std::string name = fs::relative(entry.path(), path()/relative).string();
        if (entry.is_directory())
        {
            result[name + "/"];
            continue;
        }
        std::ifstream stream(entry.path(), std::ios::binary);
        result[name].assign(std::istreambuf_iterator<char>(stream), {});
    }
    return result;
}

void SolverCase::removeResults() const
{
    for (const std::string& name : folder_.list("case"))
    {
        if (name != "0" && name != "constant" && name != "system") remove(name);
    }
}

testing::AssertionResult same(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b)
{
    for (const auto& [name, bytes] : a)
    {
        const auto found = b.find(name);
        if (found == b.end()) return testing::AssertionFailure() << name << " is missing in the second";
        if (found->second != bytes) return testing::AssertionFailure() << name << " differs";
    }
    for (const auto& [name, bytes] : b)
    {
        if (!a.contains(name)) return testing::AssertionFailure() << name << " is missing in the first";
    }
    return testing::AssertionSuccess();
}

std::vector<LoggedStep> stepsOf(const std::string& log)
{
    const std::regex form
    (
        "Time = (\\S+) s .*\n"
        "deltaT = (\\S+) s, (\\d+) sub-steps?, limited by (\\w+)\n"
        "pressure: .*\n"
        ".*max \\|U\\| = (\\S+) m/s\n"
    );
    std::vector<LoggedStep> steps;
    for (std::sregex_iterator match(log.begin(), log.end(), form), none; match != none; ++match)
    {
        const auto number = [&](int group) { return std::stod((*match)[group]); };
        steps.push_back({number(1), number(2), std::stoi((*match)[3]), (*match)[4], number(5)});
    }
    return steps;
}

}
