// SPDX-License-Identifier: GPL-3.0-or-later
#include "MeshTimes.H"

#include "device/Device.H"
#include "device/ProfileTable.H"

#include <algorithm>
#include <chrono>
#include <iostream>

namespace shizuku
{

void reportMeshTimes(LiquidSurface& surface, Span<const Position> positions, int repeats)
{
    std::vector<double> milliseconds;
    for (int k = 0; k < repeats; ++k)
    {
        const auto before = std::chrono::steady_clock::now();
        surface.build(positions);
        synchronize();
        const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - before;
        if (k >= repeats / 5) milliseconds.push_back(passed.count());
    }
    std::sort(milliseconds.begin(), milliseconds.end());
    const auto quantile = [&](double q) { return milliseconds[std::size_t(q * double(milliseconds.size() - 1) + 0.5)]; };
    std::cout << "Repeats : median " << quantile(0.5) << " ms, quartiles " << quantile(0.25) << " and " << quantile(0.75)
              << " ms, of " << milliseconds.size() << " meshes of " << positions.size << " particles, "
              << 1e3 * positions.size / quantile(0.5) << " particles/s\n";

    constexpr int profiled = 10;
    const long launchesBefore = deviceCounters().launches;
    startProfile();
    for (int k = 0; k < profiled; ++k) surface.build(positions);
    const auto times = stopProfile();
    printProfile(std::cout, times, deviceCounters().launches - launchesBefore, profiled, "mesh");
    std::cout << std::flush;
}

}
