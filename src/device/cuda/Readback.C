// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/Readback.H"

#include "device/cuda/Check.H"
#include "device/cuda/LaunchQueue.H"

#include <atomic>

namespace shizuku
{

namespace
{

// A warp brings the words to the host's memory. A copy and an event would take the GPU longer, and interrupt a graph.
__global__ void bring(Span<const std::uint32_t> words, Readback::Post post)
{
    for (int i = threadIdx.x; i < words.size; i += blockDim.x) post.words[i] = words[i];
    __syncwarp();                                       // the stamp stands behind the words of all lanes
    if (threadIdx.x == 0) post.stamp(0);
}

}

void Readback::ask(const Buffer<std::uint32_t>& words)
{
    const Post post = ask(words.size());
    device::launchQueue().enqueue<bring>(1, 32, words.span(), post);
}

// The words, behind one that says which time this is.
Readback::Post Readback::ask(int n)
{
    words_.resizeDiscarding(n + 1);
    words_.data()[0] = 0;
    before_ = device::given();
    return {words_.data() + 1, {words_.data(), ++asked_}};
}

const std::uint32_t* Readback::wait()
{
    device::wait({words_.data(), asked_}, 1, before_);
    return words_.data() + 1;
}

namespace device
{

std::size_t given() { return launchQueue().enqueued(); }

void wait(const Stamp& stamp, int n, std::size_t since)
{
    constexpr std::size_t few = 4;
    const bool runsOut = given() - since <= few;
    const cudaStream_t stream = launchQueue().stream();
    constexpr int often = 1 << 12;                      // looks at a word, until the GPU is asked whether it is well
    for (int k = 0; k < n; ++k)
    {
        for (int looks = 1; const_cast<volatile std::uint32_t*>(stamp.words)[k] != stamp.time; ++looks)
        {
            if (looks % often == 0 && cudaStreamQuery(stream) != cudaErrorNotReady) check(cudaStreamSynchronize(stream), "a kernel failed");
        }
    }
    std::atomic_thread_fence(std::memory_order_acquire);
    if (runsOut) launchQueue().idle();
}

}

}
