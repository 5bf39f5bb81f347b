// SPDX-License-Identifier: GPL-3.0-or-later
#include "SolvedCase.H"

#include "caseFiles/SampledWall.H"
#include "functionObjects/FunctionObjects.H"
#include "liquidBodies/FilledBody.H"
#include "stepping/StartCheck.H"
#include "thetaModels/ThetaField.H"

namespace shizuku
{

namespace
{

const LiquidProperties water{1e-3, 998, 1e-6, 0.0728};      // spacing, rho, nu, sigma

}

SolvedCase::SolvedCase(const std::filesystem::path& casePath, Findings& findings) : path(casePath)
{
    findings.attempt([&] { time.emplace(path); });
    readLiquid(findings);
    readWallsAndModels(findings);
    readSurfaces(findings);
    readFunctions(findings);
    readParticles(findings);
    readDictionaries(findings);
}

void SolvedCase::readLiquid(Findings& findings)
{
    findings.attempt([&] { solution_ = Dictionary::read(path / "system/solution"); });
    findings.attempt([&] { properties_ = Dictionary::read(path / "constant/liquidProperties"); });
    // Each file by itself, so that an error of the one does not hide those of the other.
    const Dictionary standIn = Dictionary::parse("spacing 1e-3; rho 998; nu 1e-6; sigma 0.0728;");
    bool good = solution_ && properties_;
    if (solution_) good &= findings.attempt([&] { LiquidProperties::read(*solution_, standIn); });
    if (properties_) good &= findings.attempt([&] { LiquidProperties::read(standIn, *properties_); });
    if (properties_ && good) findings.attempt([&] { properties_->refuseUnused(); });
    if (!solution_) return;
    findings.attempt([&]
    {
        const LiquidProperties properties = good ? LiquidProperties::read(*solution_, *properties_) : water;
        auto made = std::make_unique<Liquid>(properties, solution_->subDictOrEmpty("kernel"));
        if (good) liquid = std::move(made);
    });
}

void SolvedCase::readWallsAndModels(Findings& findings)
{
    const double start = time ? time->value() : 0;
    Liquid standIn(liquid ? liquid->properties() : water, Dictionary());
    std::unique_ptr<Walls> trial;
    findings.attempt([&] { trial = std::make_unique<Walls>(path, start, liquid ? *liquid : standIn); });
    if (!liquid || !trial || !solution_) return readModelsApart(standIn, trial.get(), findings);

    walls = std::move(trial);
    if (findings.attempt([&] { models = std::make_unique<Models>(path, *solution_, *liquid, *walls); }))
    {
        models->takeEffect(*liquid, *walls);
        findings.attempt([&] { relaxes_ = relaxesOverlap(*solution_); });
        findings.attempt([&] { solution_->refuseUnused(); });
    }
    else readModelsApart(standIn, walls.get(), findings);
}

// One model after the other, so that an error of the one does not hide those of the next.
void SolvedCase::readModelsApart(Liquid& standIn, Walls* walls, Findings& findings)
{
    std::optional<Dictionary> models;
    if (!findings.attempt([&] { models = Dictionary::read(path / "constant/models"); })) return;
    findings.attempt([&] { BodyForce::New(*models, path / "constant", standIn); });
    Walls noWalls;
    FreeSurface surface;
    if (walls) findings.attempt([&] { InterParticleForces(*models, standIn, *walls, surface); });
    if (solution_) findings.attempt([&] { Pressure::New(*models, *solution_, standIn, walls ? *walls : noWalls, surface); });
    findings.attempt([&] { Viscosity::New(*models, standIn); });
    findings.attempt([&] { ParticleShifting::New(*models, standIn, walls ? *walls : noWalls, surface); });
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

void SolvedCase::readParticles(Findings& findings)
{
    if (!liquid || !time) return;
    if (!findings.attempt([&] { liquid->read(time->path()); })) return;
    const StartLimits limits = models ? StartLimits::of(time->index(), *models->pressure) : StartLimits{};
    if (!relaxes_) findings.attempt([&] { refuseOverlap(*liquid, time->path(), limits); });
    else if (measureCrowding(*liquid).overlaps(limits))
    {
        findings.warn("the liquid overlaps itself, and is moved apart before the first step (overlaps relax)");
    }
    if (walls && time->index() == 0) findings.attempt([&] { walls->refuseLiquidInside(*liquid); });
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
