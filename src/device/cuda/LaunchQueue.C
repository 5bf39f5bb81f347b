// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/cuda/LaunchQueue.H"

#include <algorithm>
#include <utility>

namespace shizuku::device
{

LaunchQueue::LaunchQueue()
{
    int least = 0, greatest = 0;
    check(cudaStreamCreate(&stream_), "cannot create a stream");
    check(cudaDeviceGetStreamPriorityRange(&least, &greatest), "cannot tell a stream's priority");
    check(cudaStreamCreateWithPriority(&other_, cudaStreamDefault, greatest), "cannot create a stream");
    check(cudaEventCreateWithFlags(&reached_, cudaEventDisableTiming), "cannot create an event");
}

void LaunchQueue::fork()
{
    submit();
    wait(other_, stream_);
}

void LaunchQueue::join()
{
    submit();
    wait(stream_, other_);
}

void LaunchQueue::turn()
{
    submit();
    std::swap(stream_, other_);
    turned_ = !turned_;
}

void LaunchQueue::wait(cudaStream_t behind, cudaStream_t before)
{
    check(cudaEventRecord(reached_, before), "cannot record an event");
    check(cudaStreamWaitEvent(behind, reached_), "cannot wait for an event");
}

void LaunchQueue::push(const void* argument, std::size_t bytes)
{
    constexpr std::size_t alignment = 16;
    arguments_.push_back(bytes_.size());
    bytes_.resize(bytes_.size() + (bytes + alignment - 1) / alignment * alignment);
    std::memcpy(bytes_.data() + arguments_.back(), argument, bytes);
}

void LaunchQueue::submit()
{
    if (waiting_.empty()) return;
    enough_ = std::min(2 * enough_, most);
    const Forget afterwards{*this};
    pointers_.clear();
    for (const std::size_t argument : arguments_) pointers_.push_back(bytes_.data() + argument);
    if (waiting_.size() > 1 && !turned_)
    {
        check(cudaGraphLaunch(chain(), stream_), "cannot launch kernels");
        return;
    }
    for (std::size_t k = 0; k < waiting_.size(); ++k)
    {
        const cudaKernelNodeParams one = parameters(k);
        check(cudaLaunchKernel(one.func, one.gridDim, one.blockDim, one.kernelParams, 0, stream_), "cannot launch a kernel");
    }
}

LaunchQueue::Forget::~Forget()
{
    queue.waiting_.clear();
    queue.arguments_.clear();
    queue.bytes_.clear();
}

cudaGraphExec_t LaunchQueue::chain()
{
    std::vector<const void*> kernels;
    for (const Launch& launch : waiting_) kernels.push_back(launch.kernel);
    constexpr std::size_t mostChains = 512, graphsOfOften = 4, often = 32;      // chains of a run: some tens
    if (chains_.size() >= mostChains) forgetChains();
    Recurring& recurring = chains_[kernels];
    const std::size_t turn = recurring.times < often ? 0 : recurring.times % graphsOfOften;
    ++recurring.times;
    if (turn >= recurring.graphs.size()) return recurring.graphs.emplace_back(make()).executable;
    Chain& chain = recurring.graphs[turn];
    for (std::size_t k = 0; k < waiting_.size(); ++k)
    {
        if (isAsBefore(chain, k)) continue;
        const cudaKernelNodeParams now = parameters(k);
        check(cudaGraphExecKernelNodeSetParams(chain.executable, chain.nodes[k], &now), "cannot change a kernel's arguments");
    }
    chain.launches = waiting_;
    chain.bytes = bytes_;
    return chain.executable;
}

// To compare a kernel's arguments takes less than to change them.
bool LaunchQueue::isAsBefore(const Chain& chain, std::size_t k) const
{
    const auto end = [&] { return k + 1 < waiting_.size() ? arguments_[waiting_[k + 1].firstArgument] : bytes_.size(); };
    const std::size_t first = arguments_[waiting_[k].firstArgument];
    return waiting_[k].blocks == chain.launches[k].blocks && waiting_[k].threads == chain.launches[k].threads
        && std::memcmp(bytes_.data() + first, chain.bytes.data() + first, end() - first) == 0;
}

void LaunchQueue::synchronize()
{
    check(cudaStreamSynchronize(stream()), "a kernel failed");
    idle();
}

cudaKernelNodeParams LaunchQueue::parameters(std::size_t k)
{
    const Launch& launch = waiting_[k];
    cudaKernelNodeParams parameters{};
    parameters.func = const_cast<void*>(launch.kernel);
    parameters.gridDim = launch.blocks;
    parameters.blockDim = launch.threads;
    parameters.kernelParams = pointers_.data() + launch.firstArgument;
    return parameters;
}

LaunchQueue::Chain LaunchQueue::make()
{
    Chain chain;
    check(cudaGraphCreate(&chain.graph, 0), "cannot create a graph");
    for (std::size_t k = 0; k < waiting_.size(); ++k)
    {
        const cudaKernelNodeParams kernel = parameters(k);
        const cudaGraphNode_t* const before = k > 0 ? &chain.nodes.back() : nullptr;
        cudaGraphNode_t node;
        check(cudaGraphAddKernelNode(&node, chain.graph, before, k > 0 ? 1 : 0, &kernel), "cannot add a kernel");
        chain.nodes.push_back(node);
    }
    check(cudaGraphInstantiate(&chain.executable, chain.graph, 0), "cannot make a graph");
    chain.launches = waiting_;
    chain.bytes = bytes_;
    return chain;
}

void LaunchQueue::forgetChains()
{
    for (const cudaStream_t stream : {stream_, other_}) check(cudaStreamSynchronize(stream), "a kernel failed");
    for (const auto& [kernels, recurring] : chains_)
    {
        for (const Chain& chain : recurring.graphs)
        {
            cudaGraphExecDestroy(chain.executable);
            cudaGraphDestroy(chain.graph);
        }
    }
    chains_.clear();
}

LaunchQueue& launchQueue()
{
    static LaunchQueue& queue = *new LaunchQueue;
    return queue;
}

}
