// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/DeviceLink.H"

#include "core/messages/Error.H"
#include "device/Beside.H"
#include "device/HostBuffer.H"
#include "device/Profile.H"
#include "device/cuda/Check.H"
#include "device/cuda/LaunchQueue.H"
#include "parallel/nccl/NcclLink.H"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <future>
#include <optional>

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

// Says why where there is none.
OpenNccl findNccl()
{
    void* const module = dlopen("libshizukuNccl.so", RTLD_NOW);
    if (module) return reinterpret_cast<OpenNccl>(dlsym(module, "openNccl"));
    warning(std::string("What passes between GPUs goes through the host's memory, since there is no NCCL: ") + dlerror());
    return nullptr;
}

// What goes beside travels when the other stream has been given what it does meanwhile.
class BesideLink : public DeviceLink
{
public:
    void exchange(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received) const override
    {
        const device::Timed waits(device::waitForGhosts);
        pass(sent, received, device::launchQueue().stream());
    }

    void begin(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received) const override
    {
        sent_ = sent;
        received_ = received;
    }

    void end() const override
    {
        device::launchQueue().submit();
        pass(sent_, received_, device::launchQueue().other());
    }

protected:
    virtual void pass(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received, cudaStream_t stream) const = 0;

private:
    mutable std::vector<SentPiece> sent_;
    mutable std::vector<ReceivedPiece> received_;
};

// NCCL takes its time to start, and for its first exchange: both are made while this part reads its files.
class GpuToGpu : public BesideLink
{
public:
    GpuToGpu(std::unique_ptr<GpuLink> nccl, const Communicator& parts) : nccl_(std::move(nccl))
    {
        int gpu = 0;
        device::check(cudaGetDevice(&gpu), "cannot tell the selected GPU");
        const int all = parts.parts(), part = parts.part();
        started_ = std::async(std::launch::async, [this, gpu, next = (part + 1) % all, before = (part + all - 1) % all]
        {
            device::check(cudaSetDevice(gpu), "cannot select a GPU");
            nccl_->start();
            passOn(next, before);
        });
    }

    std::string name() const override { return nccl_->name(); }

private:
    void pass(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received, cudaStream_t stream) const override
    {
        if (started_.valid()) started_.get();
        std::optional<device::Beside> here;
        if (stream == device::launchQueue().other()) here.emplace();
        const device::Timed way(device::wayOfGhosts);
        nccl_->exchange(sent, received, stream);
    }

    // A byte.
    void passOn(int next, int before) const
    {
        std::byte* bytes = nullptr;
        cudaStream_t stream = nullptr;
        device::check(cudaMalloc(reinterpret_cast<void**>(&bytes), 2), "cannot allocate memory");
        device::check(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "cannot create a stream");
        nccl_->exchange({{next, bytes, 1}}, {{before, bytes + 1, 1}}, stream);
        device::check(cudaStreamSynchronize(stream), "cannot link the GPUs");
        device::check(cudaStreamDestroy(stream), "cannot destroy a stream");
        device::check(cudaFree(bytes), "cannot free memory");
    }

    std::unique_ptr<GpuLink> nccl_;
    mutable std::future<void> started_;         // is waited for where the link ends before its first exchange
};

class ThroughHost : public BesideLink
{
public:
    explicit ThroughHost(const Communicator& parts) : parts_(parts) {}

    std::string name() const override { return "the host's memory"; }

private:
    void pass(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received, cudaStream_t stream) const override
    {
        std::vector<SentPiece> out = sent;
        std::vector<ReceivedPiece> in = received;
        place(out, out_);
        place(in, in_);
        for (std::size_t k = 0; k < sent.size(); ++k)
        {
            device::check(cudaMemcpyAsync(const_cast<std::byte*>(out[k].bytes), sent[k].bytes, sent[k].size, cudaMemcpyDeviceToHost, stream), "copy from the device");
        }
        waitFor(stream);
        parts_.exchange(out, in);
        for (std::size_t k = 0; k < received.size(); ++k)
        {
            device::check(cudaMemcpyAsync(received[k].bytes, in[k].bytes, in[k].size, cudaMemcpyHostToDevice, stream), "copy to the device");
        }
        waitFor(stream);
        device::launchQueue().idle();
    }

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

    static void waitFor(cudaStream_t stream) { device::check(cudaStreamSynchronize(stream), "a kernel failed"); }

    const Communicator& parts_;
    mutable HostBuffer<std::byte> out_, in_;
};

}

std::shared_ptr<const DeviceLink> linkDevices(const Communicator& parts)
{
    const OpenNccl open = eachHasItsOwn(parts) ? findNccl() : nullptr;
    if (parts.any(!open)) return std::make_shared<ThroughHost>(parts);
    return std::make_shared<GpuToGpu>(std::unique_ptr<GpuLink>(open(parts)), parts);
}

}
