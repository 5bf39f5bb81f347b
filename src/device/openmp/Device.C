// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/messages/Error.H"
#include "device/Beside.H"
#include "device/Device.H"
#include "device/Lanes.H"
#include "device/Memory.H"
#include "device/Processors.H"
#include "device/Profile.H"
#include "device/Readback.H"
#include "device/Sharing.H"

#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

namespace shizuku
{

namespace
{

std::string processorName()
{
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
    {
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    }
    return "processor";
}

}

DeviceInfo openDevice(int)
{
    const std::size_t memory = std::size_t(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGE_SIZE);
    const std::string backend = sizeof(scalar) == 8 ? "cpuDouble" : "cpu";
    return {backend, processorName() + ", " + std::to_string(omp_get_max_threads()) + " threads", memory};
}

// A process that is bound to some processors takes no others.
void shareProcessors(int users)
{
    if (users < 2 || std::getenv("OMP_NUM_THREADS")) return;
    omp_set_num_threads(std::clamp(int(sysconf(_SC_NPROCESSORS_ONLN)) / users, 1, omp_get_num_procs()));
}

void shareAsOf(int) {}

bool sharesAsWhole() { return false; }

int sharedAs(int n) { return n; }

void synchronize() {}

DeviceCounters& deviceCounters()
{
    static DeviceCounters counters;
    return counters;
}

void Readback::ask(const Buffer<std::uint32_t>& words)
{
    words.download(ask(words.size()).words, words.size());
}

Readback::Post Readback::ask(int n)
{
    words_.resizeDiscarding(n);
    return {words_.data(), {}};
}

const std::uint32_t* Readback::wait() { return words_.data(); }

namespace device
{

std::size_t given() { return 0; }
void wait(const Stamp&, int, std::size_t) {}

namespace
{
    std::vector<std::chrono::steady_clock::time_point> marks;
}

std::size_t mark()
{
    marks.push_back(std::chrono::steady_clock::now());
    return marks.size() - 1;
}

double millisecondsBetween(std::size_t first, std::size_t second)
{
    return std::chrono::duration<double, std::milli>(marks.at(second) - marks.at(first)).count();
}

void forgetMarks() { marks.clear(); }

void beginBeside() {}
void endBeside() {}
Beside::Beside() = default;
Beside::~Beside() = default;

namespace
{
    constexpr std::size_t line = 64;        // bytes: more than any type is aligned to

    std::size_t inLines(std::size_t bytes) { return (bytes + line - 1) / line * line; }
}

void* newBlock(std::size_t bytes) noexcept
{
    constexpr std::size_t behind = lanes * 4 * sizeof(scalar);      // as many vectors
    const std::size_t all = inLines(bytes + behind);
    void* memory = std::aligned_alloc(line, all);
    if (memory) std::memset(memory, 0, all);    // what is read behind the end counts nothing, but has to be a number
    return memory;
}

void deleteBlock(void* memory) noexcept { std::free(memory); }

void* allocateHost(std::size_t bytes)
{
    void* memory = std::aligned_alloc(line, inLines(bytes));
    if (!memory && bytes > 0) throw FatalError("Cannot allocate " + std::to_string(bytes >> 20) + " MiB of memory");
    return memory;
}

void releaseHost(void* memory) noexcept { std::free(memory); }

void copyToDevice(void* target, const void* source, std::size_t bytes) { std::memcpy(target, source, bytes); }
void copyToHost(void* target, const void* source, std::size_t bytes) { std::memcpy(target, source, bytes); }
void copyOnDevice(void* target, const void* source, std::size_t bytes) { std::memcpy(target, source, bytes); }
void setBytes(void* target, int value, std::size_t bytes) { std::memset(target, value, bytes); }

}

}
