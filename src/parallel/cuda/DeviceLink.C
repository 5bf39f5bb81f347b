// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/DeviceLink.H"

#include "device/HostBuffer.H"
#include "device/cuda/Check.H"
#include "device/cuda/LaunchQueue.H"
#include "parallel/nccl/NcclLink.H"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace shizuku
{

namespace
{

using Identity = std::array<char, sizeof(cudaUUID_t::bytes)>;

// No GPU is another part's too.
bool eachHasItsOwn(const Communicator& parts)
{
    int gpu = 0;
    cudaDeviceProp properties{};
    device::check(cudaGetDevice(&gpu), "cannot tell the selected GPU");
    device::check(cudaGetDeviceProperties(&properties, gpu), "cannot read a GPU's properties");
    Identity own;
    std::memcpy(own.data(), properties.uuid.bytes, own.size());
    std::vector<Identity> all = parts.gather(own);
    std::sort(all.begin(), all.end());
    return std::adjacent_find(all.begin(), all.end()) == all.end();
}

OpenNccl findNccl()
{
    void* const module = dlopen("libshizukuNccl.so", RTLD_NOW);
    return module ? reinterpret_cast<OpenNccl>(dlsym(module, "openNccl")) : nullptr;
}

class GpuToGpu : public DeviceLink
{
public:
    explicit GpuToGpu(std::unique_ptr<const DeviceLink> nccl) : nccl_(std::move(nccl)) {}

    std::string name() const override { return nccl_->name(); }

    void exchange(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received) const override
    {
        device::launchQueue().submit();
        nccl_->exchange(sent, received);
    }

private:
    std::unique_ptr<const DeviceLink> nccl_;
};

class ThroughHost : public DeviceLink
{
public:
    explicit ThroughHost(const Communicator& parts) : parts_(parts) {}

    std::string name() const override { return "the host's memory"; }

    void exchange(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received) const override
    {
        const cudaStream_t stream = device::launchQueue().stream();
        std::vector<SentPiece> out = sent;
        std::vector<ReceivedPiece> in = received;
        place(out, out_);
        place(in, in_);
        for (std::size_t k = 0; k < sent.size(); ++k)
        {
            device::check(cudaMemcpyAsync(const_cast<std::byte*>(out[k].bytes), sent[k].bytes, sent[k].size, cudaMemcpyDeviceToHost, stream), "copy from the device");
        }
        synchronize();
        parts_.exchange(out, in);
        for (std::size_t k = 0; k < received.size(); ++k)
        {
            device::check(cudaMemcpyAsync(received[k].bytes, in[k].bytes, in[k].size, cudaMemcpyHostToDevice, stream), "copy to the device");
        }
        synchronize();
    }

private:
    // Gives each piece its place on the host.
    template<class Piece>
    static void place(std::vector<Piece>& pieces, HostBuffer<std::byte>& memory)
    {
        constexpr std::size_t block = 1 << 18;          // their sizes vary from search to search
        std::size_t all = 0;
        for (const Piece& piece : pieces) all += piece.size;
        memory.resizeDiscarding(int((all + block - 1) / block * block));
        std::byte* next = memory.data();
        for (Piece& piece : pieces)
        {
            piece.bytes = next;
            next += piece.size;
        }
    }

    static void synchronize() { device::launchQueue().synchronize(); }

    const Communicator& parts_;
    mutable HostBuffer<std::byte> out_, in_;
};

}

std::shared_ptr<const DeviceLink> linkDevices(const Communicator& parts)
{
    const OpenNccl open = eachHasItsOwn(parts) ? findNccl() : nullptr;
    if (parts.any(!open)) return std::make_shared<ThroughHost>(parts);
    return std::make_shared<GpuToGpu>(std::unique_ptr<const DeviceLink>(open(parts, device::launchQueue().stream())));
}

}
