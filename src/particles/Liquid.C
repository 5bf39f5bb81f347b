// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Liquid.H"

#include "core/time/Time.H"
#include "maths/Lattice.H"
#include "particles/ParticleFiles.H"
#include "reference/CapillaryStep.H"

#include <cmath>

namespace shizuku
{

LiquidProperties LiquidProperties::read(const Dictionary& solution, const Dictionary& liquidProperties)
{
    return
    {
        solution.lookupPositive("spacing", dimensions::length),
        liquidProperties.lookupPositive("rho", dimensions::density),
        liquidProperties.lookupPositive("nu", dimensions::kinematicViscosity, true),
        liquidProperties.lookupPositive("sigma", dimensions::surfaceTension, true)
    };
}

double LiquidProperties::characteristicTime() const
{
    constexpr double gravity = 9.81;
    return surfaceTension > 0 ? std::sqrt(particleMass() / surfaceTension) : std::sqrt(spacing / gravity);
}

double LiquidProperties::capillaryStep() const
{
    return shizuku::capillaryStep(particleMass(), surfaceTension);
}

Liquid::Liquid(const LiquidProperties& properties, const Dictionary& kernelDict)
:
    ParticleSet("liquid", properties.spacing),
    position(fields().add<Position>
    ({
        .name = "positions", .dimensions = dimensions::length, .written = true, .restarted = true, .begins = true
    })),
    velocity(fields().add<Vec3>
    ({
        .name = "U", .dimensions = dimensions::velocity, .written = true, .restarted = true, .begins = true
    })),
    predicted(fields().add<Position>({.name = "predicted", .dimensions = dimensions::length, .exchanged = true})),
    density(fields().add<scalar>({.name = "densityRatio", .dimensions = dimensions::none, .written = true, .atBirth = 1})),
    id(fields().add<std::uint32_t>
    ({
        .name = "id", .dimensions = dimensions::none, .written = true, .restarted = true, .exchanged = true
    })),
    properties_(properties),
    units_(Units::near(properties.spacing, properties.characteristicTime(), properties.particleMass())),
    spacing_(units_.toScaled(properties.spacing, dimensions::length)),
    restDensity_(units_.toScaled(properties.density, dimensions::density)),
    kernel_(makeKernel
    (
        kernelDict.lookupChoiceOr("type", kernelWords(), CubicSpline::word),
        spacing_ * scalar(kernelDict.lookupOr("support", 2.0))
    )),
    latticeSum_(std::visit
    (
        [this](const auto& W) { return shizuku::latticeSum(spacing_, W.h, [&](scalar r) { return W.W(r); }); }, kernel_
    ))
{
    const double support = kernelDict.lookupOr("support", 2.0);
    if (!(support >= 1.5 && support <= 4))
    {
        throw FatalInputError
        (
            kernelDict.where("support"), "The kernel's support is out of range",
            "a number of spacings between 1.5 and 4"
        );
    }
}

void Liquid::change(double viscosity, double surfaceTension)
{
    properties_.viscosity = viscosity;
    properties_.surfaceTension = surfaceTension;
}

std::vector<Vector3> positionsToSI(const std::vector<Position>& positions, const Units& units)
{
    std::vector<Vector3> places;
    places.reserve(positions.size());
    for (const Position& position : positions)
    {
        const Place at = placeOf(position);
        places.push_back(units.length * Vector3(quanta::lengthOf(at.x), quanta::lengthOf(at.y), quanta::lengthOf(at.z)));
    }
    return places;
}

std::vector<Vector3> velocitiesToSI(const std::vector<Vec3>& velocities, const Units& units)
{
    const double unit = units.of(dimensions::velocity);
    std::vector<Vector3> result;
    result.reserve(velocities.size());
    for (const Vec3& u : velocities) result.push_back(unit * Vector3(u.x, u.y, u.z));
    return result;
}

std::vector<Vector3> Liquid::positions() const
{
    std::vector<Position> host(owned());
    position.download(host.data(), owned());
    return positionsToSI(host, units_);
}

std::vector<Vector3> Liquid::velocities() const
{
    std::vector<Vec3> host(owned());
    velocity.download(host.data(), owned());
    return velocitiesToSI(host, units_);
}

void Liquid::read(const std::filesystem::path& timeFolder, bool mayBeEmpty)
{
    const auto folder = timeFolder / name();
    const auto refuse = [&](const std::string& reason)
    {
        std::string expected = "run fillLiquid first";
        for (const TimeFolder& other : timeFolders(timeFolder.parent_path()))
        {
            if (other.path == timeFolder || !std::filesystem::exists(other.path / name() / "positions")) continue;
            expected = "a time as it was written; remove " + timeFolder.string() + " to go on from " + other.path.string();
        }
        throw FatalInputError({folder.string(), 0}, "There is no liquid: " + reason, expected);
    };
    if (mayBeEmpty && !std::filesystem::exists(folder / "positions")) return;
    if (!std::filesystem::exists(folder / "positions")) refuse("the file positions is missing");
    if (readParticles(*this, units_, folder) == 0 && !mayBeEmpty) refuse("the list of positions is empty");
}

}
