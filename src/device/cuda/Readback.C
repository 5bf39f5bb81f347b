#include "device/Readback.H"

#include "device/cuda/Check.H"
#include "device/cuda/LaunchQueue.H"

#include <atomic>

namespace shizuku
{

namespace
{

// A warp brings the words to the host's memory, behind one that says which time this is. A copy and an event would take the GPU
// longer, and interrupt a graph.
__global__ void bring(const std::uint32_t* words, int n, std::uint32_t* host, std::uint32_t time)
{
    for (int i = threadIdx.x; i < n; i += blockDim.x) host[1 + i] = words[i];
    __threadfence_system();
    __syncwarp();
    if (threadIdx.x == 0) *const_cast<volatile std::uint32_t*>(host) = time;
}

}

void Readback::ask(const Buffer<std::uint32_t>& words)
{
    words_.resizeDiscarding(words.size() + 1);
    words_.data()[0] = 0;
    device::launchQueue().enqueue<bring>(1, 32, words.span().data, words.size(), words_.data(), ++asked_);
}

Readback::Post Readback::ask()
{
    words_.resizeDiscarding(2);
    words_.data()[0] = 0;
    return {words_.data() + 1, words_.data(), ++asked_};
}

const std::uint32_t* Readback::wait()
{
    device::LaunchQueue& queue = device::launchQueue();
    const cudaStream_t stream = queue.stream();
    constexpr int often = 1 << 12;                      // looks at the word, until the GPU is asked whether it is well
    for (int k = 1; *const_cast<volatile std::uint32_t*>(words_.data()) != asked_; ++k)
    {
        if (k % often != 0) continue;
        const cudaError_t status = cudaStreamQuery(stream);
        if (status != cudaErrorNotReady) device::check(status, "a kernel failed");
    }
    std::atomic_thread_fence(std::memory_order_acquire);
    queue.idle();
    return words_.data() + 1;
}

}
