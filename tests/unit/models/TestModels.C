// SPDX-License-Identifier: GPL-3.0-or-later
// Run-time selection of the models, and that a model which is off costs nothing.

#include "models/Models.H"

#include "device/Device.H"
#include "functionObjects/FunctionObject.H"
#include "functionObjects/ModelList.H"
#include "support/LiquidCase.H"

#include <sstream>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

using Words = std::vector<std::string>;

const Dictionary none = Dictionary::parse
(
    "pressure none; surfaceTension none; wetting none; viscosity none; bodyForce none;", "constant/models"
);

std::unique_ptr<SurfaceTension> makeTension(LiquidCase& drop, const std::string& word)
{
    const Dictionary models = Dictionary::parse("surfaceTension " + word + ";");
    return SurfaceTension::New(models, drop.liquid, drop.walls, drop.surface);
}

// A choice of its own for one keyword, and a pair force for the wetting models to continue.
Dictionary choosing(const std::string& keyword, const std::string& word)
{
    return Dictionary::parse("surfaceTension Akinci2013;\n" + keyword + " " + word + ";", "constant/models");
}

}

TEST(Models, HaveTheirWords)
{
    EXPECT_EQ(PressureTable::words(), (Words{"Clavet2005", "DFSPH", "PCISPH", "WCSPH", "completedPbf", "idealGas", "none", "pbf"}));
    EXPECT_EQ(SurfaceTensionTable::words(), (Words{"Akinci2013", "Becker2007", "Fujisawa2014", "Kondo2007", "Mueller2003", "Tartakovsky2005", "continuumSurfaceForce", "laplacePressure", "none"}));
    EXPECT_EQ(WettingTable::words(), (Words{"Akinci2013", "adhesionRatio", "contactAngle", "extendedSurface", "none"}));
    EXPECT_EQ(ViscosityTable::words(), (Words{"XSPH", "laminar", "newtonian", "none"}));
    EXPECT_EQ(VelocityCorrectionTable::words(), (Words{"keepsTurns", "none"}));
    EXPECT_EQ(BodyForceTable::words(), (Words{"gravity", "none"}));
    EXPECT_EQ(ParticleShiftingTable::words(), (Words{"closePairs", "none"}));
}

TEST(Models, SayWhatTheyAre)
{
    std::istringstream lines(modelList());
    std::size_t words = 0;
    for (std::string line; std::getline(lines, line);)
    {
        if (!line.starts_with("    ")) continue;
        ++words;
        std::istringstream parts(line);
        std::string word, first;
        EXPECT_TRUE(parts >> word >> first) << line;        // what it is begins with a word at least
    }
    const auto all = [](const auto&... tables) { return (tables.size() + ...); };
    EXPECT_EQ
    (
        words,
        all(PressureTable::words(), SurfaceTensionTable::words(), WettingTable::words(), ViscosityTable::words(), VelocityCorrectionTable::words(),
            ParticleShiftingTable::words(), BodyForceTable::words(), FunctionObjectTable::words())
    );
}

TEST(Models, AreMadeByEveryWord)
{
    LiquidCase drop;
    const auto constant = drop.folder.path() / "constant";
    for (const auto& word : PressureTable::words())
    {
        const Dictionary models = choosing("pressure", word);
        EXPECT_NE(Pressure::New(models, Dictionary(), drop.liquid, drop.walls, drop.surface), nullptr) << word;
    }
    for (const auto& word : SurfaceTensionTable::words())
    {
        const auto tension = makeTension(drop, word);
        EXPECT_EQ(tension->active(), word != "none") << word;
        const bool pairForce = word == "Akinci2013" || word == "Fujisawa2014";
        EXPECT_EQ(tension->pairCoefficients().has_value(), pairForce) << word;
    }
    for (const auto& word : WettingTable::words())
    {
        const std::string tensionWord = word == "extendedSurface" ? "continuumSurfaceForce" : "Akinci2013";
        const auto tension = makeTension(drop, word == "adhesionRatio" ? "Kondo2007" : tensionWord);
        const auto wetting = Wetting::New(choosing("wetting", word), drop.liquid, drop.walls, *tension);
        EXPECT_EQ(wetting->active(), word != "none") << word;
    }
    for (const auto& word : ViscosityTable::words())
    {
        EXPECT_NE(Viscosity::New(choosing("viscosity", word), drop.liquid), nullptr) << word;
    }
    for (const auto& word : VelocityCorrectionTable::words())
    {
        EXPECT_NE(VelocityCorrection::New(choosing("velocityCorrection", word), drop.liquid), nullptr) << word;
    }
    for (const auto& word : ParticleShiftingTable::words())
    {
        const Dictionary models = choosing("particleShifting", word);
        EXPECT_NE(ParticleShifting::New(models, drop.liquid, drop.walls, drop.surface), nullptr) << word;
    }
    for (const auto& word : BodyForceTable::words())
    {
        EXPECT_NE(BodyForce::New(choosing("bodyForce", word), constant, drop.liquid), nullptr) << word;
    }
}

// bin/newModel makes models of the kinds that have templates.
TEST(Models, OfEachKindHaveATemplate)
{
    const auto templates = std::filesystem::path(std::getenv("SHIZUKU_DIR")) / "etc/codeTemplates";
    for (const ModelKind& kind : modelKinds())
    {
        EXPECT_TRUE(std::filesystem::exists(templates / (kind.keyword + ".C"))) << kind.keyword;
        EXPECT_TRUE(std::filesystem::exists(templates / (kind.keyword + "Test.C"))) << kind.keyword;
    }
}

TEST(Models, OfAnUnknownWordListTheChoices)
{
    LiquidCase drop;
    const auto constant = drop.folder.path() / "constant";
    const auto tension = makeTension(drop, "none");
    const auto makePressure = [&](const std::string& word)
    {
        return Pressure::New(choosing("pressure", word), Dictionary(), drop.liquid, drop.walls, drop.surface);
    };
    EXPECT_TRUE(holds(messageOf([&] { makePressure("pbd"); }),
                      {"Unknown pressure model 'pbd'", "constant/models", "line 2", "Did you mean 'pbf'?", "none"}));
    EXPECT_TRUE(holds(messageOf([&] { makeTension(drop, "akinci"); }),
                      {"Unknown surfaceTension model 'akinci'", "Akinci2013", "Fujisawa2014", "none"}));
    EXPECT_TRUE(holds(messageOf([&] { Wetting::New(choosing("wetting", "angle"), drop.liquid, drop.walls, *tension); }),
                      {"Unknown wetting model 'angle'", "Akinci2013", "contactAngle", "none"}));
    EXPECT_TRUE(holds(messageOf([&] { Viscosity::New(choosing("viscosity", "xsph"), drop.liquid); }),
                      {"Unknown viscosity model 'xsph'", "Did you mean 'XSPH'?", "laminar", "none"}));
    EXPECT_TRUE(holds(messageOf([&] { VelocityCorrection::New(choosing("velocityCorrection", "keepTurns"), drop.liquid); }),
                      {"Unknown velocityCorrection model 'keepTurns'", "Did you mean 'keepsTurns'?", "none"}));
    EXPECT_TRUE(holds(messageOf([&] { ParticleShifting::New(choosing("particleShifting", "pairs"), drop.liquid, drop.walls, drop.surface); }),
                      {"Unknown particleShifting model 'pairs'", "closePairs", "none"}));
    EXPECT_TRUE(holds(messageOf([&] { BodyForce::New(choosing("bodyForce", "gravitiy"), constant, drop.liquid); }),
                      {"Unknown bodyForce model 'gravitiy'", "Did you mean 'gravity'?", "none"}));
}

TEST(Models, ThatAreOffLaunchAndAllocateNothing)
{
    LiquidCase drop;
    drop.place(latticeBall(3));
    const DeviceCounters before = deviceCounters();
    const std::size_t fields = drop.liquid.fields().entries().size();

    const auto bodyForce = BodyForce::New(none, drop.folder.path() / "constant", drop.liquid);
    InterParticleForces forces(none, drop.liquid, drop.walls, drop.surface);
    const auto pressure = Pressure::New(none, Dictionary(), drop.liquid, drop.walls, drop.surface);
    const auto filter = VelocityCorrection::New(none, drop.liquid);
    const auto viscosity = Viscosity::New(none, drop.liquid);
    const auto shifting = ParticleShifting::New(none, drop.liquid, drop.walls, drop.surface);
    bodyForce->predict(drop.liquid, 0.01f);
    forces.applyBeforeIterations(drop.liquid, drop.near, drop.walls, 0.01f);
    forces.applyInIteration(drop.liquid, drop.near, drop.walls, 0.01f);
    pressure->begin(1);
    EXPECT_TRUE(pressure->converged(drop.liquid, drop.near, drop.walls));
    pressure->correct(drop.liquid, drop.near, drop.walls);
    EXPECT_EQ(pressure->iterations(), 0);
    filter->apply(drop.liquid, drop.near, drop.walls, 0.01f);
    viscosity->apply(drop.liquid, drop.near, drop.walls, 0.01f);
    shifting->apply(drop.liquid, drop.near, drop.walls);
    drop.reconstruct(drop.surface);
    EXPECT_FALSE(forces.active());
    EXPECT_FALSE(drop.surface.active());
    EXPECT_EQ(bodyForce->acceleration(), 0);
    EXPECT_EQ(viscosity->stepLimit(drop.liquid.properties()), std::numeric_limits<double>::infinity());

    EXPECT_EQ(deviceCounters().launches, before.launches + 1);          // the prediction, which is made without a force too
    EXPECT_EQ(deviceCounters().bytes, before.bytes);
    EXPECT_EQ(drop.liquid.fields().entries().size(), fields);
}

// The free surface, its wide neighbour list and the walls' tangent planes exist for the models that ask for them alone: a step
// of the paper's models launches and holds what it did without.
TEST(Models, WithoutAFreeSurfaceLeaveItIdle)
{
    const auto layer = latticeBlock(9, 9, 1, 1, {-4, -4, -0.5f});
    for (const bool surface : {false, true})
    {
        LiquidCase drop({.walls = sampledFloor, .solidPositions = layer,
                         .solidTheta = std::vector<double>(layer.size(), 60)});
        drop.folder.write
        (
            "constant/models", surface
          ? "pressure completedPbf; surfaceTension continuumSurfaceForce; wetting extendedSurface; viscosity XSPH; bodyForce none;"
          : "pressure pbf; surfaceTension Fujisawa2014; wetting contactAngle; viscosity XSPH; bodyForce none;"
        );
        const Models models(drop.folder.path(), Dictionary(), drop.liquid, drop.walls);
        models.takeEffect(drop.liquid, drop.walls);
        EXPECT_EQ(models.freeSurface->active(), surface);
        EXPECT_EQ(models.freeSurface->support(), surface ? FreeSurface::usualSupport(drop.liquid) * drop.liquid.spacing() : 0);
        drop.place({{0, 0, 0.5f}, {1, 0, 0.5f}, {0, 1, 0.5f}});
        EXPECT_EQ(drop.walls.view(drop.liquid).planes.normal.size > 0, surface);

        drop.near.update(drop.liquid, models.freeSurface->support());
        EXPECT_EQ(drop.near.wide(drop.liquid).support > 0, surface);
        const DeviceCounters before = deviceCounters();
        drop.reconstruct(*models.freeSurface);
        EXPECT_EQ(deviceCounters().launches > before.launches, surface);
        EXPECT_EQ(deviceCounters().bytes > before.bytes, surface);
    }
}

// A case without walls pays nothing for them either.
TEST(Models, AtAbsentWallsLaunchNothing)
{
    LiquidCase drop;
    drop.place(latticeBall(3));
    const auto tension = makeTension(drop, "Akinci2013");
    const auto wetting = Wetting::New(choosing("wetting", "contactAngle"), drop.liquid, drop.walls, *tension);
    Buffer<Vec3> acceleration(drop.liquid.all());
    acceleration.setZero();
    const DeviceCounters before = deviceCounters();
    wetting->apply(drop.liquid, drop.near, drop.walls, acceleration);
    drop.walls.update(drop.liquid);
    drop.walls.project(drop.liquid);
    EXPECT_EQ(deviceCounters().launches, before.launches);
    EXPECT_EQ(deviceCounters().bytes, before.bytes);
}

TEST(Models, TogetherRefuseEntriesThatNobodyKnows)
{
    LiquidCase drop;
    const std::string chosen = "pressure pbf; surfaceTension none; wetting none; viscosity XSPH; bodyForce none;\n";
    const auto make = [&](const std::string& more)
    {
        drop.folder.write("constant/models", chosen + more);
        return messageOf([&] { Models(drop.folder.path(), Dictionary(), drop.liquid, drop.walls); });
    };
    EXPECT_EQ(make("XSPHCoeffs { c 0.1; } laminarCoeffs { noSlip no; }"), "no error");      // not chosen: may stay
    EXPECT_TRUE(holds(make("XSPHCoeffs { d 0.1; }"), {"constant/models", "line 2", "'d'"}));
    EXPECT_TRUE(holds(make("viscositee none;"), {"viscositee"}));
}

TEST(InterParticleForces, ActInThePlaceThatForceCouplingChooses)
{
    for (const bool everyIteration : {false, true})
    {
        LiquidCase drop;
        const Dictionary models = Dictionary::parse
        (
            "surfaceTension Akinci2013; wetting none; forceCoupling "
          + std::string(everyIteration ? "everyIteration;" : "predictor;")
        );
        InterParticleForces forces(models, drop.liquid, drop.walls, drop.surface);
        drop.place({{0, 0, 0}, {1.2f, 0, 0}});
        const auto moved = [&] { return drop.inOrder(drop.liquid.predicted)[1].x != rounded(1.2f * drop.liquid.spacing()); };
        forces.applyBeforeIterations(drop.liquid, drop.near, drop.walls, 0.5f);
        EXPECT_EQ(moved(), !everyIteration);
        forces.applyInIteration(drop.liquid, drop.near, drop.walls, 0.5f);
        EXPECT_TRUE(moved());
    }
    LiquidCase drop;
    const auto message = [&](const std::string& text)
    {
        const Dictionary wrong = Dictionary::parse(text);
        return messageOf([&] { InterParticleForces(wrong, drop.liquid, drop.walls, drop.surface); });
    };
    EXPECT_TRUE(holds(message("surfaceTension none; wetting none; forceCoupling once;"), {"once", "predictor", "everyIteration"}));
    EXPECT_TRUE(holds(message("surfaceTension laplacePressure; wetting none; forceCoupling everyIteration;"), {"free surface", "forces of pairs"}));
}
