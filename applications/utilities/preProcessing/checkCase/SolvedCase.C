// SPDX-License-Identifier: GPL-3.0-or-later
#include "SolvedCase.H"

#include "caseFiles/SampledWall.H"
#include "functionObjects/FunctionObjects.H"
#include "liquidBodies/FilledBody.H"
#include "thetaModels/ThetaField.H"

namespace shizuku
{

namespace
{

const LiquidProperties water{1e-3, 998, 1e-6, 0.0728};      // spacing, rho, nu, sigma

}

SolvedCase::SolvedCase(const std::filesystem::path& casePath, Findings& findings) : CaseSetup(casePath)
{
    findings.attempt([&] { time.emplace(path); });
    readLiquid(findings);
    readWallsAndModels(findings);
    readSurfaces(findings);
    readFunctions(findings);
    checkParticles(findings);
    readDictionaries(findings);
}

void SolvedCase::readLiquid(Findings& findings)
{
    findings.attempt([&] { readSolution(); });
    findings.attempt([&] { readLiquidProperties(); });
    // Each file by itself, so that an error of the one does not hide those of the other.
    const Dictionary standIn = Dictionary::parse("spacing 1e-3; rho 998; nu 1e-6; sigma 0.0728;");
    bool good = solution && liquidProperties;
    if (solution) good &= findings.attempt([&] { LiquidProperties::read(*solution, standIn); });
    if (liquidProperties) good &= findings.attempt([&] { LiquidProperties::read(standIn, *liquidProperties); });
    if (good) findings.attempt([&] { makeLiquid(); });
    else if (solution) findings.attempt([&] { Liquid(water, solution->subDictOrEmpty("kernel")); });
}

void SolvedCase::readWallsAndModels(Findings& findings)
{
    const double start = time ? time->value() : 0;
    Liquid standIn(liquid ? liquid->properties() : water, Dictionary());
    if (!liquid)
    {
        findings.attempt([&] { Population(path, standIn); });
        std::unique_ptr<Walls> trial;
        findings.attempt([&] { trial = std::make_unique<Walls>(path, start, standIn); });
        return readModelsApart(standIn, trial.get(), findings);
    }
    findings.attempt([&] { makeWalls(start); });
    findings.attempt([&] { if (walls) makePopulation(); else Population(path, standIn); });
    if (!walls || !findings.attempt([&] { makeModels(); })) return readModelsApart(standIn, walls.get(), findings);
    findings.attempt([&] { readOverlaps(); });
    findings.attempt([&] { refuseUnused(); });
}

// One model after the other, so that an error of the one does not hide those of the next.
void SolvedCase::readModelsApart(Liquid& standIn, const Walls* known, Findings& findings)
{
    std::optional<Dictionary> dict;
    if (!findings.attempt([&] { dict = Dictionary::read(path / "constant/models"); })) return;
    const Walls none{};
    const Walls& around = known ? *known : none;
    FreeSurface surface;
    findings.attempt([&] { BodyForce::New(*dict, path / "constant", standIn); });
    if (known) findings.attempt([&] { InterParticleForces(*dict, standIn, around, surface); });
    if (solution) findings.attempt([&] { Pressure::New(*dict, *solution, standIn, around, surface); });
    findings.attempt([&] { VelocityCorrection::New(*dict, standIn); });
    findings.attempt([&] { Viscosity::New(*dict, standIn); });
    findings.attempt([&] { ParticleShifting::New(*dict, standIn, around, surface); });
}

// What sampleSurface and sampleTheta read of the walls, whether or not they have run; and whether they still say what these made of it.
void SolvedCase::readSurfaces(Findings& findings)
{
    if (!std::filesystem::exists(path / "constant/walls")) return;
    std::vector<SampledWall> sampled;
    if (!findings.attempt([&] { sampled = readSampledWalls(path); })) return;
    const bool particles = haveSolidParticles(path);
    if (particles)
    {
        findings.attempt([&]
        {
            if (const std::string text = otherSurfaces(path); !text.empty()) findings.warn(text);
            for (const std::string& text : branchingSheets(path)) findings.warn(text);
        });
    }
    else
    {
        for (const SampledWall& wall : sampled) findings.attempt([&] { refuseMissingSurface(wall); });
    }
    if (!std::filesystem::exists(path / "constant/wettability")) return;        // a model that needs angles has said so
    if (!sampled.empty() && !particles) return;                                 // and patches are not known yet
    const auto folder = time ? findInstance(path, time->value(), "solid/theta") : std::filesystem::path();
    if (sampled.empty() || folder.empty())
    {
        findings.attempt([&] { caseTheta(path); });
        return;
    }
    const std::string text = otherTheta(path, folder);
    if (!text.empty()) findings.warn(text);
}

void SolvedCase::readFunctions(Findings& findings)
{
    if (!time) return;
    findings.attempt([&]
    {
        FunctionObjects functions(*time, liquid ? liquid->properties().spacing : water.spacing, true);
        if (!liquid || !walls || !models) return;
        const Neighbourhood near(*liquid);
        FlowView flow(*time, *liquid, near, *walls, *models);
        functions.modelsMade(flow);
    });
}

void SolvedCase::checkParticles(Findings& findings)
{
    if (!liquid || !time) return;
    if (walls) findings.attempt([&] { refuseCrossingWalls(*time); });
    if (!findings.attempt([&] { readParticles(*time); })) return;
    findings.attempt([&] { refuseOverlap(*time); });
    if (relaxes && measureCrowding(*liquid).overlaps(limits(*time)))
    {
        findings.warn("the liquid overlaps itself, and is moved apart before the first step (overlaps relax)");
    }
    if (walls) findings.attempt([&] { refuseLiquidInside(*time); });
}

// What the utilities read: the syntax of every dictionary, and the bodies of liquid.
void SolvedCase::readDictionaries(Findings& findings)
{
    for (const char* folder : {"system", "constant"})
    {
        if (!std::filesystem::is_directory(path / folder)) continue;
        for (const auto& entry : std::filesystem::directory_iterator(path / folder))
        {
            const std::filesystem::path& file = entry.path();
            if (!entry.is_regular_file() || file.has_extension() || file.filename().string().ends_with('~')) continue;
            findings.attempt([&] { Dictionary::read(file); });
        }
    }
    const auto bodies = path / "system/fillLiquidDict";
    if (!liquid || !std::filesystem::exists(bodies)) return;
    findings.attempt([&] { readBodies(Dictionary::read(bodies), path, liquid->properties().spacing); });
}

}
