// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/CaseSetup.H"

#include "device/KeptMemory.H"
#include "parallel/AllParts.H"
#include "wallMotions/CrossingWalls.H"

namespace shizuku
{

void CaseSetup::make(double start)
{
    readSolution();
    readLiquidProperties();
    makeLiquid();
    makeWalls(start);
    makeModels();
    makePopulation();
    readOverlaps();
    refuseUnused();
}

void CaseSetup::readSolution()
{
    solution = Dictionary::read(path / "system/solution");
}

void CaseSetup::readLiquidProperties()
{
    liquidProperties = Dictionary::read(path / "constant/liquidProperties");
}

std::unique_ptr<Liquid> CaseSetup::emptyLiquid() const
{
    return std::make_unique<Liquid>(LiquidProperties::read(*solution, *liquidProperties), solution->subDictOrEmpty("kernel"));
}

void CaseSetup::makeLiquid()
{
    liquid = emptyLiquid();
    if (const auto sides = Sides::read(path, liquid->units().length)) liquid->ghosts().repeat(*sides);
    liquidProperties->refuseUnused();
}

void CaseSetup::makeWalls(double start)
{
    walls = std::make_unique<Walls>(path, start, *liquid);
}

void CaseSetup::makeModels()
{
    models = std::make_unique<Models>(path, *solution, *liquid, *walls);
    if (liquid->ghosts().images()) models->refuseGhostBlind(*liquid, "The liquid cannot go on across sides");
    models->takeEffect(*liquid, *walls);
    if (walls->freeBody()) body.emplace(path, *liquid, *walls, *models);
}

void CaseSetup::makePopulation()
{
    population.emplace(path, *liquid);
    if (population->mayComeIn()) population->refuseInWalls(*walls, *emptyLiquid());
}

void CaseSetup::readOverlaps()
{
    relaxes = relaxesOverlap(*solution);
}

void CaseSetup::refuseUnused() const
{
    solution->refuseUnused();
}

void CaseSetup::readParticles(const Time& time)
{
    liquid->read(time.path(), !Sources::names(path).empty());
    if (const Images* images = liquid->ghosts().images()) images->sides().refuseOutside(liquid->positions());
    if (population) population->begin(*liquid);
}

void CaseSetup::refuseBadStart(const Time& time) const
{
    refuseCrossingWalls(time);
    refuseOverlap(time);
    refuseLiquidInside(time);
    device::dropKeptMemory();               // of reading, the first cut and these checks: steps want other sizes
}

void CaseSetup::refuseCrossingWalls(const Time& time) const
{
    shizuku::refuseCrossingWalls(path, time.value(), time.endTime(), liquid->properties().spacing);
}

void CaseSetup::refuseOverlap(const Time& time) const
{
    if (!relaxes) shizuku::refuseOverlap(*liquid, time.path(), limits(time));
}

void CaseSetup::refuseLiquidInside(const Time& time) const
{
    if (time.index() == 0) inAllParts(liquid->parts(), [&] { walls->refuseLiquidInside(*liquid); });
}

StartLimits CaseSetup::limits(const Time& time) const
{
    return models ? StartLimits::of(time.index(), *models->pressure) : StartLimits{};
}

int CaseSetup::relaxOverlap(const Time& time, Neighbourhood& near)
{
    return relaxes ? shizuku::relaxOverlap(*liquid, near, *walls, limits(time)) : 0;
}

}
