// SPDX-License-Identifier: GPL-3.0-or-later
#include "StartWarnings.H"

#include "caseFiles/SolidParticles.H"
#include "drops/KnownFaults.H"
#include "drops/MotionWarnings.H"
#include "drops/SuspectNumbers.H"
#include "parallel/AllParts.H"

#include <cmath>
#include <optional>
#include <utility>

#include <sys/resource.h>

namespace shizuku
{

namespace
{

// Of all parts' particles, in part 0, as the device has them.
template<class T>
std::vector<T> ofAllParts(const Liquid& liquid, const Buffer<T>& values)
{
    std::vector<T> own(liquid.owned());
    values.download(own.data(), liquid.owned());
    return gatherListsAtFirst(liquid.parts(), std::move(own));
}

// The calling thread leaves its core to others: mpirun binds each part to a single one, which the look would share with the steps. On Linux a priority is a thread's.
void comeLast()
{
    setpriority(PRIO_PROCESS, 0, 19);
}

// Where a single plane bears the liquid.
std::string flatteningWarning(const FlowView& flow)
{
    const LiquidProperties& p = flow.properties();
    const std::optional<Vec3> normal = flow.walls.constraints().only();
    const auto g = flow.models.bodyForce->uniform();
    const double pressing = normal ? -(g[0]*normal->x + g[1]*normal->y + g[2]*normal->z) : 0;
    if (!(pressing > 0 && p.surfaceTension > 0)) return {};
    return puddleWarning(std::sqrt(p.surfaceTension/(p.density*pressing)), flow.walls.contactAngles().second, p.spacing);
}

}

StartWarnings::StartWarnings(const FlowView& flow, const Liquid& liquid) : flow_(flow)
{
    constexpr int most = 2000000;                           // particles
    if (flow.time.index() > 0) return;
    const bool looks = flow.particles() <= most;
    std::vector<Position> positions = looks ? ofAllParts(liquid, liquid.position) : std::vector<Position>();
    std::vector<Vec3> velocities = looks ? ofAllParts(liquid, liquid.velocity) : std::vector<Vec3>();
    if (liquid.parts().part() > 0) return;
    start_ = std::async
    (
        std::launch::async, [positions = std::move(positions), velocities = std::move(velocities), units = liquid.units(), spacing = flow.properties().spacing]
        {
            comeLast();
            LiquidAtStart start{positionsToSI(positions, units), {}};
            start.bodies = separateBodies(start.positions, velocitiesToSI(velocities, units), spacing);
            return start;
        }
    );
}

StartWarnings::~StartWarnings()
{
    try
    {
        print();
    }
    catch (const std::exception&)
    {
        // What a case lacks the run itself has said.
    }
}

void StartWarnings::printIfSoon()
{
    constexpr int few = 100000;                             // particles: a twentieth of a second
    if (flow_.particles() <= few) print();
}

void StartWarnings::print()
{
    if (start_.valid()) warn(start_.get());
}

// Of many solid particles none are read once more for it: checkCase looks at any.
void StartWarnings::warnOfPlaces(const LiquidAtStart& start) const
{
    constexpr int most = 200000;                            // solid particles
    const std::filesystem::path& path = flow_.time.casePath();
    const int particles = flow_.walls.particles();
    if (particles > most) return;
    const SolidParticles solid = particles > 0 ? readSolidParticles(path) : SolidParticles();
    const std::vector<AnalyticSurface> surfaces = readAnalyticSurfaces(Dictionary::read(path / "constant/walls"));
    warnOf(suspectPlaces(path, start.bodies, surfaces, solid.positions));
    warnOf(knownFaults(path, solid, surfaces, start.positions, flow_.properties().spacing));
}

void StartWarnings::warn(const LiquidAtStart& start) const
{
    const std::filesystem::path& path = flow_.time.casePath();
    warnOf(suspectEntries(path));
    warnOfPlaces(start);
    const LiquidProperties& p = flow_.properties();
    std::vector<std::string> warnings = resolutionWarnings(start.bodies, p.spacing);
    if (const std::string text = flatteningWarning(flow_); !text.empty()) warnings.push_back(text);
    for (const std::string& text : warnings) warning(text, {(path / "system/solution").string(), 0});
    const FlowScales scales{0, 0, 0, p.density, p.viscosity, p.surfaceTension};
    for (const std::string& text : motionWarnings(flow_.models.dict.lookup<std::string>("viscosity"), start.bodies, scales))
    {
        warning(text, {(path / "constant/models").string(), 0});
    }
}

}
