// Fills bodies with liquid particles: system/fillLiquidDict -> 0/liquid/{positions,U}.

#include "core/arguments/runApplication.H"
#include "core/fieldFile/AtomicFile.H"
#include "core/time/Controls.H"
#include "geometry/VectorField.H"
#include "geometry/liquidBodies/LiquidChecks.H"

#include <iostream>

using namespace shizuku;

namespace
{

const ApplicationInfo info
{
    "fillLiquid", "Fill bodies with liquid particles on a lattice (system/fillLiquidDict to 0/liquid).", {}
};

double readSpacing(const std::filesystem::path& casePath)
{
    return Dictionary::read(casePath/"system"/"solution").lookupPositive("spacing", dimensions::length);
}

FilledBody readBody(const Dictionary& bodies, const std::string& name, double spacing)
{
    const Dictionary dict = bodies.subDict(name);
    FilledBody body{name, dict.where(), nullptr, {}, {}};
    body.shape = LiquidBodyTable::New("liquid body", dict.lookup<std::string>("type"), dict.where("type"), dict);
    if (dict.found("velocity")) body.velocity = dict.lookupDimensionedVector("velocity", dimensions::velocity);
    body.positions = fillLattice(*body.shape, spacing, dict.where());
    return body;
}

std::vector<FilledBody> readBodies(const Dictionary& fillLiquidDict, double spacing)
{
    const Dictionary bodies = fillLiquidDict.subDict("bodies");
    std::vector<FilledBody> result;
    for (const std::string& name : bodies.dictKeys()) result.push_back(readBody(bodies, name, spacing));
    if (result.empty())
    {
        throw FatalInputError(bodies.where(), "There is no body of liquid", "drop { type sphere; ... }");
    }
    fillLiquidDict.refuseUnused();
    return result;
}

void report(const FilledBody& body, double spacing)
{
    const double volume = body.positions.size()*spacing*spacing*spacing, exact = body.shape->volume();
    std::cout << body.name << ": " << body.positions.size() << " particles, volume " << volume << " m3, of the shape "
              << exact << " m3 (" << std::showpos << 100*(volume/exact - 1) << std::noshowpos << " %), velocity "
              << str(body.velocity) << " m/s\n";
}

void writeLiquid(const std::filesystem::path& folder, const std::vector<FilledBody>& bodies, const WriteFormat& format)
{
    std::vector<Vector3> positions, velocities;
    for (const FilledBody& body : bodies)
    {
        positions.insert(positions.end(), body.positions.begin(), body.positions.end());
        velocities.insert(velocities.end(), body.positions.size(), body.velocity);
    }
    writeFolderAtomically(folder, [&](const std::filesystem::path& partial)
    {
        writeField(partial/"positions", toField("positions", dimensions::length, positions), format);
        writeField(partial/"U", toField("U", dimensions::velocity, velocities), format);
    });
    std::cout << "Wrote 0/liquid: " << positions.size() << " particles\n";
}

void run(const Arguments& args)
{
    const std::filesystem::path& casePath = args.casePath();
    const WriteFormat format = readControls(Dictionary::read(casePath/"system"/"controlDict")).format;
    const double spacing = readSpacing(casePath);
    const std::vector<FilledBody> bodies = readBodies(Dictionary::read(casePath/"system"/"fillLiquidDict"), spacing);
    const std::vector<AnalyticSurface> walls = readAnalyticSurfaces(Dictionary::read(casePath/"constant"/"walls"));
    const SolidParticles solid = haveSolidParticles(casePath) ? readSolidParticles(casePath) : SolidParticles();

    std::cout << "Particle spacing " << spacing << " m\n";
    for (const FilledBody& body : bodies)
    {
        report(body, spacing);
        refuseInsideWalls(body, walls, spacing);
        refuseInsideSolid(body, solid, spacing);
    }
    refuseOverlaps(bodies, spacing);
    writeLiquid(casePath/"0"/"liquid", bodies, format);
}

}

int main(int argc, char** argv)
{
    return runApplication(argc, argv, info, run);
}
