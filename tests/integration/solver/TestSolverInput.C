// SPDX-License-Identifier: GPL-3.0-or-later
// Bad input: what is wrong, where it stands, what would be right; and nothing half-written is left.

#include "SolverCase.H"

#include "core/fieldFile/FieldFile.H"

#include <limits>

namespace shizuku::test
{

namespace
{

class Input : public SolverCase
{
protected:
    struct Bad
    {
        std::string text;                   // of the file
        std::vector<std::string> parts;     // of the message
    };

    // Each text in place of the file's own, which comes back behind.
    void expectRefusals(const std::string& file, const std::vector<Bad>& list) const
    {
        const std::string good = read(file);
        for (const Bad& bad : list)
        {
            SCOPED_TRACE(file + ": " + bad.text);
            write(file, bad.text);
            std::vector<std::string> parts = bad.parts;
            parts.push_back("file: " + (path()/file).string());
            expectRefusal(parts);
        }
        write(file, good);
    }

    void expectMissing(const std::string& file, const std::vector<std::string>& parts) const
    {
        SCOPED_TRACE(file);
        std::filesystem::rename(path()/file, folder_.path()/"aside");
        expectRefusal(parts);
        std::filesystem::rename(folder_.path()/"aside", path()/file);
    }

    static std::string vectors(const std::string& dimensions, const std::string& internalField)
    {
        return "FoamFile\n{\n    format ascii;\n    class vectorField;\n}\ndimensions " + dimensions + ";\n"
             + "internalField " + internalField + ";\n";
    }
};

INSTANTIATE_TEST_SUITE_P(Devices, Input, testing::ValuesIn(devices()));

}

TEST_P(Input, TheCaseItselfIsGood)
{
    const Outcome outcome = solve();
    EXPECT_EQ(outcome.status, 0) << outcome.text;
}

TEST_P(Input, MissingCase)
{
    const std::string absent = (path()/"absent").string();
    const Outcome outcome = run(program("pbfDroplet") + " -device " + device() + " -case " + absent);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"FATAL IO ERROR", "case directory does not exist", "case/absent", "-case DIR"}));
    expectMissing("system/controlDict", {"not a case", "system/controlDict is missing"});
    expectMissing("0", {"no time folder"});
}

TEST_P(Input, MissingFiles)
{
    expectMissing("system/solution", {"system/solution"});
    expectMissing("constant/liquidProperties", {"constant/liquidProperties", "copy one to change it, e.g. ", "tutorials/sessileDrop/constant/liquidProperties"});
    expectMissing("constant/models", {"constant/models"});
    expectMissing("constant/walls", {"constant/walls", "tutorials/sessileDrop/constant/walls"});
    expectMissing("constant/g", {"constant/g"});
    expectMissing("constant/wettability", {"constant/wettability"});
    expectMissing("constant/solid", {"constant/solid/positions", "run sampleSurface"});
    expectMissing("constant/solid/normals", {"missing", "constant/solid/normals"});
    expectMissing("0/solid/theta", {"solid/theta", "run sampleTheta"});
    expectMissing("0/liquid", {"no liquid", "0/liquid", "run fillLiquid"});
    expectMissing("0/liquid/U", {"missing", "0/liquid/U"});
}

TEST_P(Input, ControlDict)
{
    const std::string good = "endTime 1;\nwriteInterval 1;\n";
    expectRefusals
    (
        "system/controlDict",
        {
            {"endTime 1;\nwriteInterval 1;\n", {"'deltaT' is missing"}},
            {good + "deltat 1e-3;", {"Entry 'deltat' in dictionary", "did you mean 'deltaT'? That is missing"}},
            {good + "deltaT 1e-3;\nmaxco 1;", {"'maxco'", "line 4", "Did you mean 'maxCo'"}},
            {good + "deltaT 0;", {"'deltaT' is 0", "line 3", "> 0"}},
            {good + "deltaT -1e-3;", {"'deltaT' is -0.001", "line 3", "> 0"}},
            {good + "deltaT soon;", {"'deltaT'", "the word 'soon'", "line 3", "a number"}},
            {good + "deltaT [0 1 0 0 0 0 0] 1e-3;", {"'deltaT'", "dimensions", "line 3", "[0 0 1 0 0 0 0]"}},
            {good + "deltaT 1e-3;\nadjustTimeStep maybe;", {"'adjustTimeStep'", "maybe", "line 4", "yes"}},
            {good + "deltaT 1e-3;\nmaxSubSteps 0;", {"maxSubSteps is 0", "line 4"}},
            {good + "deltaT 1e-3;\nmaxCo -1;", {"'maxCo' is -1", "line 4"}},
            {good + "deltaT 1e-3;\nstartFrom latest;", {"'latest'", "line 4", "latestTime", "firstTime"}},
            {good + "deltaT 1e-3;\nfunctions { a { type liquidStat; } }", {"'liquidStat'", "line 4", "liquidState"}},
            {good + "deltaT 1e-3;\nfunctions\n{\n    a { type liquidState; interval 2; }\n}", {"'interval'", "line 6"}},
            {good + "deltaT 1e-3;\nfunctions\n{\n    drop liquidState;\n}", {"'drop'", "functions", "line 6"}},
            {good + "deltaT 1e-3", {"line 3"}},
        }
    );
}

TEST_P(Input, Boundary)
{
    write("constant/boundary", "");
    const std::string box = "min (0 -6e-3 0);\nmax (0 6e-3 0);\n";
    expectRefusals
    (
        "constant/boundary",
        {
            {"", {"'sides' is missing"}},
            {box + "sides { yMin cyclic; }", {"The side yMin is cyclic, and yMax is not", "line 3", "yMin cyclic; yMax cyclic;"}},
            {box + "sides { yMin periodic; }", {"'periodic'", "line 3", "cyclic", "symmetryPlane"}},
            {box + "sides { zMin cyclic;\nzMax cyclic; }", {"The sides zMin and zMax are at 0 and 0 m", "line 2"}},
            {box + "sides { left open; }", {"'left'", "line 3"}},
            {box + "side { }", {"'side'", "did you mean 'sides'"}},
            {"min (0 -0.5e-3 0);\nmax (0 0.5e-3 0);\nsides { yMin cyclic; yMax cyclic; }", {"beyond the side yMin, at y = -0.0005 m", "line 3"}},
            {"min (0 -1.5e-3 0);\nmax (0 1.5e-3 0);\nsides { yMin cyclic; yMax cyclic; }", {"are 0.003 m apart, and particles see each other across", "line 3"}},
            {"min (0 0 0);\nmax (1 1 1);\nsides { yMin symmetryPlane; }", {"beyond the side yMin, at y = 0 m", "line 3", "liquid above it"}}
        }
    );
    remove("constant/boundary");
}

TEST_P(Input, Solution)
{
    expectRefusals
    (
        "system/solution",
        {
            {"spacng 1e-3;", {"Entry 'spacng' in dictionary", "did you mean 'spacing'? That is missing"}},
            {"spacing 0;", {"'spacing' is 0", "line 1", "> 0"}},
            {"\nspacing -1e-3;", {"'spacing' is -0.001", "line 2"}},
            {"spacing (1 2 3);", {"'spacing'", "a list", "line 1", "a number"}},
            {"spacing [0 0 1 0 0 0 0] 1e-3;", {"'spacing'", "[0 0 1 0 0 0 0]", "[0 1 0 0 0 0 0]"}},
            {"spacing 1e-3;\npresure { tolerance 1; }", {"'presure'", "line 2", "Did you mean 'pressure'"}},
            {"spacing 1e-3;\npressure\n{\n tolerence 1;\n}", {"'tolerence'", "line 4", "Did you mean 'tolerance'"}},
            {"spacing 1e-3;\npressure { maxIterations 0; }", {"'maxIterations'", "line 2", "1 or more"}},
            {"spacing 1e-3;\npressure { maxIterations many; }", {"'maxIterations'", "'many'", "line 2", "an integer"}},
            {"spacing 1e-3;\nkernel { type cubicspline; }", {"'cubicspline'", "line 2", "cubicSpline", "poly6Spiky"}},
            {"spacing 1e-3;\nkernel { support 40; }", {"support", "line 2", "1.5 and 4"}},
            {"spacing 1e-3;\nkernel { support 1; }", {"support", "line 2", "1.5 and 4"}},
        }
    );
}

TEST_P(Input, LiquidProperties)
{
    expectRefusals
    (
        "constant/liquidProperties",
        {
            {"nu 1e-6;\nsigma 0.07;", {"'rho' is missing"}},
            {"rho 0;\nnu 1e-6;\nsigma 0.07;", {"'rho' is 0", "line 1"}},
            {"rho -998;\nnu 1e-6;\nsigma 0.07;", {"'rho' is -998", "line 1"}},
            {"rho 998;\nnu -1e-6;\nsigma 0.07;", {"'nu' is -1e-06", "line 2", ">= 0"}},
            {"rho 998;\nnu 1e-6;\nsigma nan;", {"'sigma'", "line 3"}},
            {"rho water;\nnu 1e-6;\nsigma 0.07;", {"'rho'", "'water'", "line 1", "a number"}},
            {"rho 998;\nnu [1 0 0 0 0 0 0] 1e-6;\nsigma 0.07;", {"'nu'", "line 2", "[0 2 -1 0 0 0 0]"}},
            {"rho 998;\nnu 1e-6;\nsigma 0.07;\nmu 1e-3;", {"'mu'", "line 4", "Did you mean 'nu'"}},
        }
    );
}

TEST_P(Input, Models)
{
    const std::string good = "pressure pbf;\nsurfaceTension Fujisawa2014;\nwetting contactAngle;\nviscosity XSPH;\n";
    expectRefusals
    (
        "constant/models",
        {
            {good, {"'bodyForce' is missing"}},
            {good + "bodyforce none;", {"Entry 'bodyforce' in dictionary", "did you mean 'bodyForce'? That is missing"}},
            {good + "bodyForce wind;", {"bodyForce", "'wind'", "line 5", "gravity", "none"}},
            {good + "bodyForce none; presure none;", {"'presure'", "line 5", "Did you mean 'pressure'"}},
            {good + "bodyForce none;\nXSPHCoeffs { d 1; }", {"'d'", "line 6", "XSPHCoeffs"}},
            {good + "bodyForce none;\nXSPHCoeffs 1;", {"'XSPHCoeffs'", "line 6", "XSPHCoeffs { ... }"}},
            {"pressure pbf; surfaceTension none; wetting contactAngle; viscosity none; bodyForce none;",
                {"wetting", "surfaceTension Akinci2013 or Fujisawa2014"}},
            {"pressure pbf; surfaceTension Akinci2031; wetting none; viscosity none; bodyForce none;",
                {"surfaceTension", "'Akinci2031'", "line 1", "Did you mean 'Akinci2013'", "Fujisawa2014", "none"}},
            {"pressure sph; surfaceTension none; wetting none; viscosity none; bodyForce none;",
                {"pressure", "'sph'", "pbf", "none"}},
            {"pressure pbf; surfaceTension Fujisawa2014; wetting angle; viscosity none; bodyForce none;",
                {"wetting", "'angle'", "contactAngle", "Akinci2013"}},
            {"pressure pbf; surfaceTension none; wetting none; viscosity honey; bodyForce none;",
                {"viscosity", "'honey'", "laminar", "XSPH"}},
        }
    );
    expectRefusals
    (
        "constant/g",
        {
            {"value 9.81;", {"'value'", "a vector", "line 1"}},
            {"dimensions [0 1 -1 0 0 0 0];\nvalue (0 0 -9.81);", {"[0 1 -1 0 0 0 0]", "[0 1 -2 0 0 0 0]", "line 1"}},
        }
    );
}

TEST_P(Input, Walls)
{
    const std::string plane = "side\n{\n    type plane;\n    point (-3.5e-3 0 0);\n    ";
    expectRefusals
    (
        "constant/walls",
        {
            {"side { type plain; }", {"'type' is 'plain'", "line 1", "Did you mean 'plane'", "cylinder", "particles"}},
            {"side { point (0 0 0); }", {"'type' is missing", "side"}},
            {plane + "norml (1 0 0);\n}", {"Entry 'norml' in dictionary", "did you mean 'normal'? That is missing"}},
            {plane + "normal (1 0 0);\n    angle 60;\n}", {"'angle'", "line 6"}},
            {plane + "normal (0 0 0);\n}", {"normal", "line 5", "no direction"}},
            {plane + "normal 1;\n}", {"'normal'", "line 5", "a vector"}},
            {"ball { type sphere; centre (0 0 -1); radius 0; liquid outside; }", {"'radius' is 0"}},
            {"ball { type sphere; centre (0 0 -1); radius 1e-3; liquid around; }", {"'around'", "inside", "outside"}},
        }
    );
    expectRefusals
    (
        "constant/wettability",
        {
            {"floor { theta 60; }", {"'side' has no contact angle"}},
            {"side { theta 60; }\nlid { theta 90; }", {"no patch or wall 'lid'", "line 2", "floor", "side"}},
            {"side { theta 60; roughness 1; }", {"'roughness'", "line 1"}},
            {"side { thet 60; }", {"Entry 'thet' in dictionary", "did you mean 'theta'? That is missing"}},
            {"\nside { theta -1; }", {"is -1", "line 2", "0 to 180"}},
            {"\nside { type stripes; }", {"'side'", "type stripes", "line 2", "type particles"}},
        }
    );
}

TEST_P(Input, LiquidInsideASolid)
{
    write("constant/walls", "floor { type particles; }\nlid { type plane; point (0 0 4e-3); normal (0 0 -1); }\n");
    write("constant/wettability", "lid { theta 90; }");
    expectRefusal({"inside the solid 'lid'", "0.0045) m", "constant/walls at line 2"});

    // The sampled floor, turned upside down: the block is behind it.
    write("constant/walls", "floor { type particles; }\n");
    write("constant/solid/normals", vectors("[0 0 0 0 0 0 0]", "uniform (0 0 -1)"));
    expectRefusal({"inside the solid 'floor'", "constant/walls", "half a spacing"});
}

// A lattice of 0.8 of the spacing that the case has, at the start of a run and at a restart.
TEST_P(Input, OverlappingLiquid)
{
    const std::string good = read("system/solution"), crowded = "spacing 1.25e-3;\npressure { maxIterations 6; }\n";
    const auto refused = [&](std::vector<std::string> parts, const std::string& file)
    {
        parts.push_back("file: " + (path()/file).string());
        expectRefusal(parts);
    };
    write("system/solution", crowded);
    refused({"overlapping itself", "of its 294 particles", "0.8 spacings", "Run fillLiquid", "0.00125 m"}, "0/liquid/positions");
    write("system/solution", good);
    ASSERT_EQ(solve().status, 0);
    write("system/solution", crowded);
    refused({"a spacing of 0.001 m"}, "0.004/liquid/positions");
    // Particles that do not tell their spacing.
    const std::string meta = "    meta        { spacing 0.001; }\n";
    std::string positions = read("0.004/liquid/positions");
    ASSERT_NE(positions.find(meta), std::string::npos);
    write("0.004/liquid/positions", positions.erase(positions.find(meta), meta.size()));
    refused({"overlapping itself"}, "0.004/liquid/positions");

    // Asked to, it moves them apart; what checkCase says of that is no error.
    removeResults();
    write("system/solution", crowded + "overlaps relax;\n");
    const Outcome outcome = solve();
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"its particles were moved apart in ", "\nEnd\n"}));
}

// Particles written by a run say at which spacing they were made; these stand for another volume with another one.
TEST_P(Input, LiquidOfAnotherSpacing)
{
    EXPECT_EQ(solve().status, 0);
    write("system/solution", "spacing 1.02e-3;\n");
    expectRefusal({"a spacing of 0.001 m", "0.00102 m", "liquid/positions", "fillLiquid"});
}

TEST_P(Input, Fields)
{
    const std::string length = "[0 1 0 0 0 0 0]", velocity = "[0 1 -1 0 0 0 0]";
    expectRefusals
    (
        "0/liquid/positions",
        {
            {vectors(length, "nonuniform List<vector> 2((0 0 1e-3)(0 nan 2e-3))"), {"element 1", "NaN", "line 7"}},
            {vectors(length, "nonuniform List<vector> 2((0 0 1e-3)(0 inf 2e-3))"), {"element 1", "line 7"}},
            {vectors(length, "nonuniform List<vector> 1((0 0 1e-3)(0 0 2e-3))"), {"2 elements", "line 7"}},
            {vectors(length, "nonuniform List<scalar> 2(1e-3 2e-3)"), {"List<scalar>", "List<vector>", "line 7"}},
            {vectors(length, "nonuniform List<vector> 2((0 0 1e-3)(0 0 wet))"), {"wet", "line 7"}},
            {vectors(velocity, "nonuniform List<vector> 1((0 0 1e-3))"), {velocity, length, "line 6"}},
            {vectors(length, "nonuniform List<vector> 1((0 0 1e30))"), {"1e+30", "element 0", "too large"}},
            {vectors(length, "uniform (0 0 1e-3)"), {"uniform"}},
            {"", {"internalField"}},
        }
    );
    expectRefusals
    (
        "0/liquid/U",
        {
            {vectors(velocity, "nonuniform List<vector> 2((0 0 0)(0 0 0))"), {"2 elements", "294 elements", "line 7"}},
            {vectors(velocity, "uniform (0 nan 0)"), {"found nan", "a finite number"}},
            {vectors(length, "uniform (0 0 0)"), {length, velocity, "line 6"}},
        }
    );
    const auto scalars = [](const std::string& internalField)
    {
        return "FoamFile\n{\n    format ascii;\n    class scalarField;\n}\ndimensions [0 0 0 0 0 0 0];\n"
               "internalField " + internalField + ";\n";
    };
    expectRefusals
    (
        "0/solid/theta",
        {
            {scalars("nonuniform List<scalar> 2(60 60)"), {"2 elements", "324 elements", "line 7"}},
            {scalars("uniform 200"), {"200 degrees", "0 to 180"}},
            {vectors("[0 0 0 0 0 0 0]", "uniform (60 0 0)"), {"vectorField", "scalarField", "line 4"}},
        }
    );
}

TEST_P(Input, NoParticles)
{
    write("0/liquid/positions", vectors("[0 1 0 0 0 0 0]", "nonuniform List<vector> 0()"));
    write("0/liquid/U", vectors("[0 1 -1 0 0 0 0]", "uniform (0 0 0)"));
    expectRefusal({"no liquid", "empty", "0/liquid", "run fillLiquid"});
}

TEST_P(Input, LastTimeThatIsNotWhole)
{
    write("0.002/liquid/U", "");
    expectRefusal({"no liquid", "0.002/liquid", "remove", "to go on from", "/0\n"});
    std::filesystem::remove_all(path()/"0.002");
    std::filesystem::copy(path()/"0", path()/"0.003", std::filesystem::copy_options::recursive);
    const Outcome outcome = solve("-dry-run");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"0.003", "no uniform/time", "first start"}));
}

TEST_P(Input, LiquidFarFromTheOrigin)
{
    const auto at = [&](const std::string& place)
    {
        write("0/liquid/positions", vectors("[0 1 0 0 0 0 0]", "nonuniform List<vector> 1((" + place + "))"));
        write("0/liquid/U", vectors("[0 1 -1 0 0 0 0]", "uniform (0 0 0)"));
    };
    at("0 -50 0.01");                   // 50,000 spacings
    EXPECT_EQ(solve("-dry-run").status, 0);
    at("0 -5000 0.01");                 // more than 2^22: places are not told apart there
    expectRefusal({"-5000", "is too large", "0/liquid/positions"});
}

TEST_P(Input, BinaryFields)
{
    for (const std::string name : {"positions", "U"})
    {
        const auto file = path()/"0/liquid"/name;
        writeField(file, readField(file), {.binary = true});
    }
    ASSERT_EQ(solve("-dry-run").status, 0);
    for (const std::string name : {"0/liquid/positions", "0/liquid/U"})
    {
        SCOPED_TRACE(name);
        const std::string whole = read(name);
        ASSERT_GT(whole.size(), std::size_t(12*particles));
        write(name, whole.substr(0, whole.size() - 1000));
        expectRefusal({"truncated", "element", "294 elements of 12 bytes", name});
        // In the last vector, which stands before ");\n".
        std::string poisoned = whole;
        const float bad = std::numeric_limits<float>::quiet_NaN();
        poisoned.replace(whole.size() - 15, 4, reinterpret_cast<const char*>(&bad), 4);
        write(name, poisoned);
        expectRefusal({"element 293 is NaN", name});
        write(name, whole);
    }
}

TEST_P(Input, UnknownOptions)
{
    expectRefusal({"'-dryrun'", "Did you mean '-dry-run'", "-noFunctionObjects"}, "-dryrun");
    expectRefusal({"'-dt'", "-device"}, "-dt 3");
    expectRefusal({"'fast'", "-help"}, "fast");
}

TEST_P(Input, ADeviceThatIsNotThere)
{
    const Contents before = contents();
    const auto refusal = [&](const std::string& command, const std::vector<std::string>& parts)
    {
        const Outcome outcome = run(command + " -case " + path().string());
        EXPECT_EQ(outcome.status, 1) << outcome.text;
        EXPECT_TRUE(holds(outcome.text, parts));
        EXPECT_TRUE(same(before, contents()));
    };
    for (const std::string folder : {"bin", "lib"}) std::filesystem::create_directory(folder_.path()/folder);
    const std::string core = "lib/libshizukuCore.so";
    std::filesystem::create_symlink(environment("SHIZUKU_BUILD") + "/" + core, folder_.path()/core);
    for (const std::string application : {"pbfDroplet", "meshSurface"})
    {
        refusal(program(application) + " -device gpu", {"'gpu'", "auto", "cpu", "cuda"});
        refusal(program(application) + " -device", {"-device has no value"});
        // Without the GPU, without its driver or without the module: each of them names the device.
        for (const std::string form : {"-device cuda", "--device cuda", "-device=cuda"})
        {
            refusal("CUDA_VISIBLE_DEVICES= " + program(application) + " " + form, {"FATAL ERROR", "'cuda'", "cpu"});
        }
        // An installation that has the launcher and the core, but no module.
        std::filesystem::copy_file(program(application), folder_.path()/"bin"/application);
        refusal
        (
            (folder_.path()/"bin"/application).string() + " -device cpu",
            {"'cpu'", "built without it", "lib" + application + "-cpu.so"}
        );
    }
}

TEST_P(Input, AFileInTheWayOfATime)
{
    write("0.002", "a file of the user's");
    control("writeInterval 2;");
    expectRefusal({"Cannot write", "case/0.002", "not a folder"});
}

// It fails behind the time loop, which has gone on: the run ends all the same, and keeps what was written before.
TEST_P(Input, AWriteThatFailsKeepsTheTimesBefore)
{
    write("0.004", "a file of the user's");
    control("endTime 1; writeInterval 2; writeFormat binary; functions { drop { type liquidState; } }");
    const Outcome outcome = solve();
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(holds(outcome.text, {"FATAL ERROR", "Cannot write", "case/0.004", "not a folder", "pbfDroplet: stopped"}));
    EXPECT_EQ(readField(path()/"0.002/liquid/U", FieldType::vector, dimensions::velocity).elements(), std::size_t(particles));
    EXPECT_TRUE(exists("0.002/uniform/time"));
    EXPECT_EQ(read("0.004"), "a file of the user's");
    for (const auto& [name, bytes] : contents()) EXPECT_EQ(name.find(".partial"), std::string::npos) << name;
    for (const std::string time : {"0.006", "0.008", "1"}) EXPECT_FALSE(exists(time)) << time;
}

TEST_P(Input, AnUnwritableCase)
{
    // Root may write everywhere unless it gives up that right.
    const std::string humbly = geteuid() == 0 ? "setpriv --bounding-set=-dac_override " : "";
    namespace fs = std::filesystem;
    const auto mode = fs::status(path()).permissions();
    fs::permissions(path(), fs::perms::owner_read | fs::perms::owner_exec);
    ASSERT_NE(run(humbly + "touch " + (path()/"probe").string()).status, 0);
    // At the start, not at the first write.
    expectRefusal({"Cannot write", path().string(), "Permission denied"}, "", humbly);
    EXPECT_EQ(run(humbly + command("pbfDroplet", "-dry-run")).status, 0);
    fs::permissions(path(), mode);
}

// A full disk: no file may grow beyond 8 KiB, which the positions need.
TEST_P(Input, AFullDisk)
{
    const std::string full = "ulimit -f 16; trap '' XFSZ;";
    expectRefusal({"Cannot write", "liquid/positions", "File too large"}, "", full);
    control("writeFormat binary; functions { drop { type liquidState; } } endTime 0.1; writeInterval 100;");
    const Outcome outcome = run(full + command("pbfDroplet", ""));
    EXPECT_EQ(outcome.status, 1) << outcome.text;
    EXPECT_TRUE(holds(outcome.text, {"Cannot write", "liquidState.csv", "File too large"}));
    EXPECT_FALSE(exists(path()/"0.1"));         // no time is there without the rows that lead up to it
    for (const auto& [name, bytes] : contents()) EXPECT_EQ(name.find(".partial"), std::string::npos) << name;
}

TEST_P(Input, ARunThatDiverges)
{
    ASSERT_EQ(solve().status, 0);
    // Finite, but absurd.
    control("adjustTimeStep no; deltaT 1; endTime 10;");
    const std::string kept = "last good state is kept in " + (path()/"0.004").string();
    expectRefusal
    (
        {"diverged", "m/s", "particle spacings in one step of 1 s", "The fastest is particle ", ", at (", "times as long as the capillary limit",
         "Set adjustTimeStep yes", kept}
    );
    // With sub-steps it needs too many of them.
    control("deltaT 10; endTime 100;");
    expectRefusal({"sub-steps", "maxSubSteps 1000", "deltaT", "The fastest is particle ", kept});
}

}
