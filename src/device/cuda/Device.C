// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/Beside.H"
#include "device/Device.H"
#include "device/Memory.H"
#include "device/Processors.H"
#include "device/Profile.H"
#include "device/cuda/Check.H"
#include "device/cuda/LaunchQueue.H"
#include "device/cuda/SmallBlocks.H"

#include <cuda_runtime.h>

#include <cstdlib>
#include <vector>

namespace shizuku
{

using device::check;

DeviceInfo openDevice(int user)
{
    int count = 0;
    const cudaError_t status = cudaGetDeviceCount(&count);
    if (status != cudaSuccess || count == 0)
    {
        throw FatalError
        (
            "Device 'cuda' was asked for but no GPU answers: "
          + std::string(status == cudaSuccess ? "none is there" : cudaGetErrorString(status))
          + "\n    Valid choices are auto, cpu, cuda; 'auto' takes the CPU where there is no GPU."
        );
    }
    const int gpu = user % count;
    const std::string name = "GPU " + std::to_string(gpu);
    check(cudaSetDevice(gpu), ("cannot select " + name).c_str());
    cudaDeviceProp properties{};
    check(cudaGetDeviceProperties(&properties, gpu), ("cannot read the properties of " + name).c_str());
    return {"cuda", properties.name, properties.totalGlobalMem, std::string(properties.uuid.bytes, sizeof properties.uuid.bytes)};
}

// Processors have little to do.
void shareProcessors(int) {}

void synchronize()
{
    device::launchQueue().synchronize();
}

DeviceCounters& deviceCounters()
{
    static DeviceCounters counters;
    return counters;
}

namespace device
{

namespace
{
    std::vector<cudaEvent_t> marks;
}

std::size_t mark()
{
    cudaEvent_t event;
    check(cudaEventCreate(&event), "cannot create an event");
    check(cudaEventRecord(event, launchQueue().stream()), "cannot record an event");
    marks.push_back(event);
    return marks.size() - 1;
}

double millisecondsBetween(std::size_t first, std::size_t second)
{
    float milliseconds = 0;
    check(cudaEventElapsedTime(&milliseconds, marks.at(first), marks.at(second)), "cannot read events");
    return milliseconds;
}

void forgetMarks()
{
    for (const cudaEvent_t event : marks) cudaEventDestroy(event);
    marks.clear();
}

void beginBeside() { launchQueue().fork(); }

void endBeside()
{
    const Timed waits(waitForGhosts);
    launchQueue().join();
}

Beside::Beside() { launchQueue().turn(); }
Beside::~Beside() { launchQueue().turn(); }

void* newBlock(std::size_t bytes) noexcept
{
    void* memory = nullptr;
    if (cudaMalloc(&memory, bytes) == cudaSuccess) return memory;
    cudaGetLastError();                     // forgets it: a smaller block may still be had
    return nullptr;
}

void deleteBlock(void* memory) noexcept
{
    launchQueue().submit();                 // who still wants it
    cudaFree(memory);
}

void* allocateHost(std::size_t bytes)
{
    void* memory = nullptr;
    if (bytes == 0) return memory;
    check(cudaMallocHost(&memory, bytes), ("cannot allocate " + std::to_string(bytes >> 20) + " MiB of host memory").c_str());
    return memory;
}

void releaseHost(void* memory) noexcept
{
    if (!memory) return;
    launchQueue().submit();                 // who still writes it
    cudaDeviceSynchronize();
    cudaFreeHost(memory);
}

void copyToDevice(void* target, const void* source, std::size_t bytes)
{
    check(cudaMemcpyAsync(target, source, bytes, cudaMemcpyHostToDevice, launchQueue().stream()), "copy to the device");
    launchQueue().synchronize();
}

void copyToHost(void* target, const void* source, std::size_t bytes)
{
    check(cudaMemcpyAsync(target, source, bytes, cudaMemcpyDeviceToHost, launchQueue().stream()), "copy from the device");
    launchQueue().synchronize();
}

void copyOnDevice(void* target, const void* source, std::size_t bytes)
{
    if (enqueueCopy(target, source, bytes)) return;
    check(cudaMemcpyAsync(target, source, bytes, cudaMemcpyDeviceToDevice, launchQueue().stream()), "copy on the device");
}

void setBytes(void* target, int value, std::size_t bytes)
{
    if (enqueueSet(target, value, bytes)) return;
    check(cudaMemsetAsync(target, value, bytes, launchQueue().stream()), "set memory");
}

}

}
