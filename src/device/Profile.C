// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/Profile.H"

#include "device/Device.H"

#include <cxxabi.h>

#include <algorithm>
#include <cstdlib>
#include <map>

namespace shizuku
{

namespace
{

struct Call
{
    const char* name;
    std::size_t begin, end;
};

constexpr std::size_t untimed = -1;

bool on = false;
std::vector<Call> calls;

std::string readable(const char* name)
{
    int status = 0;
    char* demangled = abi::__cxa_demangle(name, nullptr, nullptr, &status);
    std::string text = status == 0 ? demangled : name;
    std::free(demangled);
    for (const std::string space : {"(anonymous namespace)::", "shizuku::", "device::"})
    {
        for (auto at = text.find(space); at != std::string::npos; at = text.find(space)) text.erase(at, space.size());
    }
    return text;
}

}

void startProfile()
{
    calls.clear();
    device::forgetMarks();
    on = true;
}

std::vector<KernelTime> stopProfile()
{
    synchronize();
    on = false;
    std::map<std::string, KernelTime> sums;
    for (const Call& call : calls)
    {
        const std::string kernel = readable(call.name);
        KernelTime& sum = sums[kernel];
        sum.kernel = kernel;
        ++sum.calls;
        sum.milliseconds += device::millisecondsBetween(call.begin, call.end);
    }
    calls.clear();
    device::forgetMarks();
    std::vector<KernelTime> times;
    for (const auto& [name, time] : sums) times.push_back(time);
    std::sort(times.begin(), times.end(), [](const auto& a, const auto& b) { return a.milliseconds > b.milliseconds; });
    return times;
}

namespace device
{

Timed::Timed(const char* name) : call_(on ? calls.size() : untimed)
{
    if (on) calls.push_back({name, mark(), 0});
}

Timed::~Timed()
{
    if (call_ != untimed) calls[call_].end = mark();
}

CountedKernel::CountedKernel(const char* name) : time_(name) { ++deviceCounters().launches; }

}

}
