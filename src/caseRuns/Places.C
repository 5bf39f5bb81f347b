// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseRuns/Places.H"

#include "core/messages/Error.H"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <thread>

namespace shizuku
{

namespace
{

constexpr int mostPlaces = 4096;

int positiveWhole(const Arguments& args, const std::string& option)
{
    const double value = args.getDouble(option);
    if (value >= 1 && value <= mostPlaces && value == std::floor(value)) return int(value);
    throw FatalInputError
    (
        {}, "Option -" + option + " has the value '" + args.get(option) + "'",
        "a whole number from 1 to " + std::to_string(mostPlaces)
    );
}

std::vector<std::string> cudaDevices()
{
    std::vector<std::string> devices;
    if (const char* const visible = std::getenv("CUDA_VISIBLE_DEVICES"))
    {
        std::istringstream list(visible);
        for (std::string device; std::getline(list, device, ',');) devices.push_back(device);
        return devices;
    }
    FILE* const listing = popen("nvidia-smi -L 2>/dev/null", "r");
    if (!listing) return devices;
    char line[512];
    while (std::fgets(line, sizeof line, listing))
    {
        if (std::string(line).starts_with("GPU ")) devices.push_back(std::to_string(devices.size()));
    }
    pclose(listing);
    return devices;
}

}

std::vector<Option> placeOptions(int perDevice)
{
    return
    {
        {"device", "auto|cuda|cpu", "where the cases compute; handed to ./Allrun where it is given", "auto"},
        {"jobs", "N", "Run N cases at a time (default: one for each core; on GPUs -perDevice for each)", ""},
        {"perDevice", "N", "Run N cases at a time on each GPU", std::to_string(perDevice)}
    };
}

std::vector<Place> places(const Arguments& args)
{
    const std::vector<std::string> devices =
        args.get("device") == "cpu" ? std::vector<std::string>{} : cudaDevices();
    if (devices.empty() && args.get("device") == "cuda")
    {
        throw FatalInputError({}, "Option -device asks for cuda, but no GPU is here", "-device cpu, or auto");
    }
    if (devices.empty() && args.found("perDevice"))
    {
        throw FatalInputError({}, "Option -perDevice is given, but the cases run on the CPU", "-jobs N");
    }

    const int cores = int(std::max(1u, std::thread::hardware_concurrency()));
    int count = devices.empty() ? cores : positiveWhole(args, "perDevice")*int(devices.size());
    if (args.found("jobs")) count = positiveWhole(args, "jobs");

    std::vector<Place> result(count);
    for (int i = 0; i < count; ++i)
    {
        if (!std::getenv("OMP_NUM_THREADS"))
        {
            result[i].environment["OMP_NUM_THREADS"] = std::to_string(std::max(1, cores/count));
        }
        if (devices.empty()) continue;
        const std::string& device = devices[i%devices.size()];
        result[i].environment["CUDA_VISIBLE_DEVICES"] = device;
        result[i].device = "GPU " + device;
    }
    return result;
}

}
