#include "core/messages/Error.H"
#include "device/Device.H"
#include "device/Memory.H"
#include "device/Profile.H"
#include "device/Readback.H"

#include <cuda_runtime.h>

#include <cstdlib>
#include <vector>

namespace shizuku
{

namespace
{

void check(cudaError_t status, const std::string& what)
{
    if (status != cudaSuccess)
    {
        throw FatalError("CUDA: " + what + ": " + cudaGetErrorString(status));
    }
}

}

DeviceInfo openDevice()
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
    check(cudaSetDevice(0), "cannot select GPU 0");
    cudaDeviceProp properties{};
    check(cudaGetDeviceProperties(&properties, 0), "cannot read the properties of GPU 0");
    return {"cuda", properties.name, properties.totalGlobalMem};
}

void synchronize()
{
    check(cudaDeviceSynchronize(), "a kernel failed");
}

DeviceCounters& deviceCounters()
{
    static DeviceCounters counters;
    return counters;
}

Readback::Readback()
{
    cudaEvent_t event;
    check(cudaEventCreateWithFlags(&event, cudaEventDisableTiming), "cannot create an event");
    event_ = event;
}

Readback::~Readback() { cudaEventDestroy(static_cast<cudaEvent_t>(event_)); }

void Readback::ask(const Buffer<std::uint32_t>& words)
{
    words_.resizeDiscarding(words.size());
    const std::size_t bytes = words.size() * sizeof(std::uint32_t);
    check(cudaMemcpyAsync(words_.data(), words.span().data, bytes, cudaMemcpyDeviceToHost), "copy from the device");
    check(cudaEventRecord(static_cast<cudaEvent_t>(event_)), "cannot record an event");
}

const std::uint32_t* Readback::wait()
{
    check(cudaEventSynchronize(static_cast<cudaEvent_t>(event_)), "a kernel failed");
    return words_.data();
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
    check(cudaEventRecord(event), "cannot record an event");
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

void checkLaunch()
{
    check(cudaGetLastError(), "cannot launch a kernel");
}

void* newBlock(std::size_t bytes) noexcept
{
    void* memory = nullptr;
    if (cudaMalloc(&memory, bytes) == cudaSuccess) return memory;
    cudaGetLastError();                     // forgets it: a smaller block may still be had
    return nullptr;
}

void deleteBlock(void* memory) noexcept { cudaFree(memory); }

void* allocateHost(std::size_t bytes)
{
    void* memory = nullptr;
    if (bytes == 0) return memory;
    check(cudaMallocHost(&memory, bytes), "cannot allocate " + std::to_string(bytes >> 20) + " MiB of host memory");
    return memory;
}

void releaseHost(void* memory) noexcept
{
    cudaFreeHost(memory);
}

void copyToDevice(void* target, const void* source, std::size_t bytes)
{
    check(cudaMemcpy(target, source, bytes, cudaMemcpyHostToDevice), "copy to the device");
}

void copyToHost(void* target, const void* source, std::size_t bytes)
{
    check(cudaMemcpy(target, source, bytes, cudaMemcpyDeviceToHost), "copy from the device");
}

void copyOnDevice(void* target, const void* source, std::size_t bytes)
{
    check(cudaMemcpyAsync(target, source, bytes, cudaMemcpyDeviceToDevice), "copy on the device");
}

void setBytes(void* target, int value, std::size_t bytes)
{
    check(cudaMemsetAsync(target, value, bytes), "set memory");
}

}

}
