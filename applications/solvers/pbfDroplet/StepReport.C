// SPDX-License-Identifier: GPL-3.0-or-later
#include "StepReport.H"

#include "SlipReport.H"
#include "caseFiles/SampledWall.H"
#include "core/arguments/runApplication.H"
#include "parallel/AllParts.H"
#include "thetaModels/ThetaField.H"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <sstream>
#include <thread>
#include <utility>

namespace shizuku
{

namespace
{

struct Signal
{
    int number = 0;
    void add(const Signal& other) { number = std::max(number, other.number); }
};

void warnOfOtherSolid(const Time& time, const Walls& walls)
{
    if (const std::string text = otherSurfaces(time.casePath()); !text.empty()) warning(text);
    const auto file = time.casePath() / "constant/wettability";
    if (!walls.angles() || !std::filesystem::exists(file)) return;
    const std::string text = otherTheta(time.casePath(), findInstance(time.casePath(), time.value(), "solid/theta"));
    if (!text.empty()) warning(text);
}

}

void reportStart(const FlowView& flow)
{
    if (flow.walls.particles() > 0) warnOfOtherSolid(flow.time, flow.walls);
    std::cout << "Liquid particles " << flow.particles() << ", solid particles " << flow.walls.particles()
              << ", analytic surfaces " << flow.walls.surfaces() << std::endl;
    if (flow.walls.particles() + flow.walls.surfaces() == 0 || flow.properties().surfaceTension == 0) return;
    if (const std::string text = slipReport(flow.models.dict, flow.properties().spacing); !text.empty()) std::cout << text << std::endl;
}

void limitStepsOfBlobs(const FlowView& flow, const Liquid& liquid, TimeStep& step)
{
    constexpr std::size_t small = 20;                       // particles, of a body
    constexpr int most = 100000;                            // of liquid that may be all small bodies
    constexpr double calm = 1.4;                            // maxCapillaryCo
    if (!step.mostCapillaryCo())
    {
        const std::vector<Vector3> positions = flow.particles() > most ? std::vector<Vector3>() : gatherListsAtFirst(liquid.parts(), liquid.positions());
        const std::vector<SeparateBody> bodies = positions.empty() ? std::vector<SeparateBody>()
            : separateBodies(positions, std::vector<Vector3>(positions.size()), flow.properties().spacing);
        const bool areSmall = !bodies.empty() && bodies.front().particles.size() <= small;
        step.limitCapillaryCo(liquid.parts().any(areSmall) ? calm : TimeStep::unlimited);
    }
    if (*step.mostCapillaryCo() == TimeStep::unlimited) return;
    std::cout << "No body of liquid had more than " << small << " particles: maxCapillaryCo is at most " << *step.mostCapillaryCo()
              << ", so that none bursts\n";
}

void reportReady(const Time& time)
{
    if (time.running())
    {
        std::cout << "Ready for the first step after " << clockTime() << " s" << std::endl;
        return;
    }
    if (time.value() > time.endTime() - TimeState::tolerance*time.deltaT())
    {
        std::cout << "Nothing is left to do: the case has reached its endTime, " << time.endTime() << " s.\n"
                  << "    To go on, set a later endTime in system/controlDict. To begin anew, clean the case (./Allclean), or remove its times but for 0." << std::endl;
        return;
    }
    std::cout << "Nothing is done: stopAt in system/controlDict stops the run at its start.\n"
              << "    To go on, set stopAt to endTime." << std::endl;
}

void reportRelaxation(int rounds)
{
    if (rounds > 0) std::cout << "The liquid overlapped itself: its particles were moved apart in " << rounds << " rounds\n";
}

namespace
{

std::string stepsMade(const SubSteps& steps)
{
    if (steps.count == 0) return "no sub-step: the liquid is at rest, and sleeps";
    return std::to_string(steps.count) + (steps.count > 1 ? " sub-steps" : " sub-step") + ", limited by " + steps.limit;
}

}

void reportStep(const SubSteps& steps, FlowView& flow, const Population& population, const FunctionObjects& functions)
{
    const LiquidState& state = flow.state();
    std::cout
        << "\nTime = " << flow.time.name() << " s  (" << flow.time.progress() << ")\n"
        << "deltaT = " << steps.dt << " s, " << stepsMade(steps) << '\n'
        << "pressure: iterations " << flow.models.pressure->iterations()
        << ", density error average " << state.averageDensityError << ", maximum " << state.maxDensityError << '\n'
        << "volume = " << state.volume << " m3, kinetic energy = " << state.kineticEnergy
        << " J, max |U| = " << state.maxSpeed << " m/s\n";
    std::cout << population.report(flow.numbers(), flow.properties().particleVolume(), flow.particles());
    std::cout << functions.report() << executionTime() << std::endl;
}

void changePopulation(CaseSetup& setup, Neighbourhood& near, FlowView& flow, Time& time, double from, const DeviceInfo& device)
{
    const Population::Change change = setup.population->endStep(*setup.liquid, from, time.value(), device.memoryBytes);
    if (!change.any) return;
    near.recount();
    flow.recount();
    std::string reason;
    if (flow.particles() == 0 && !setup.population->mayComeIn()) reason = "all liquid was taken out";
    if (change.isFull) reason = "the device would have no memory for more liquid. A larger spacing, or outlets, leave more";
    if (reason.empty()) return;
    std::cout << "\nThe present step is the last: " << reason << std::endl;
    time.stopHere();
}

void stopWhereAsked(Time& time, const FunctionObjects& functions, const Communicator& parts)
{
    const std::string reason = functions.reasonToEnd();
    if (!parts.any(parts.part() == 0 && !reason.empty()) || !time.running()) return;
    std::cout << "\nThe next step is the last. " << reason << std::endl;
    time.stop();
}

Interruption stopWhereSignalled(Time& time, const StopSignals& signals, const Communicator& parts)
{
    const Interruption interruption{parts.fold(Signal{signals.received().signal}).number};
    if (interruption.signal == 0 || !time.running()) return {};
    std::cout << "\nThe present step is the last. " << interruption.name() << " came; another one ends the run at once" << std::endl;
    time.stopHere();
    return interruption;
}

void endWhereInterrupted(const Interruption& interruption, const Communicator& parts)
{
    if (interruption.signal == 0) return;
    parts.any(true);                    // part 0 has written all
    if (parts.part() > 0) std::this_thread::sleep_for(std::chrono::milliseconds(300));       // and says so before mpirun ends it
    throw interruption;
}

void warnOfSharedDevices(const DeviceInfo& device, const Communicator& parts)
{
    std::array<char, 16> identity{};
    if (device.identity.size() != identity.size()) return;
    std::copy(device.identity.begin(), device.identity.end(), identity.begin());
    auto all = parts.gather(identity);
    std::sort(all.begin(), all.end());
    const std::size_t gpus = std::unique(all.begin(), all.end()) - all.begin();
    if (gpus < all.size()) warning(std::to_string(all.size()) + " parts share " + std::to_string(gpus) + " GPUs: one part a GPU is fastest");
}

void reportCosts(const Liquid& liquid, const CaseWriter& writer)
{
    const Communicator& parts = liquid.parts();
    const auto bytes = parts.gather(deviceCounters().peakBytes);
    const auto particles = parts.gather(liquid.owned());
    const std::size_t most = std::max_element(bytes.begin(), bytes.end()) - bytes.begin();
    std::cout << "\nMemory on the device: " << bytes[most] / 1048576.0 << " MiB (" << bytes[most] / std::max(1, particles[most])
              << " bytes a liquid particle)" << (bytes.size() > 1 ? ", of the part that needs most" : "") << "\nWriting: the time loop waited " << writer.waited() << " s for it" << std::endl;
}

}
