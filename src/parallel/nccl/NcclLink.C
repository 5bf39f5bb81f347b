// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/nccl/NcclLink.H"

#include <nccl.h>

#include <cstdlib>
#include <exception>
#include <stdexcept>

namespace shizuku
{

namespace
{

void check(ncclResult_t result, const char* what)
{
    if (result == ncclSuccess || result == ncclInProgress) return;
    throw std::runtime_error(std::string("NCCL cannot ") + what + ": " + ncclGetErrorString(result));
}

// Channels of a pair of GPUs. All are set up with the first exchange: 32, NCCL's own choice between H200s, take a second longer than 4, and exchanges of ghosts
// are no faster by them. What the user's environment says holds.
void limitChannels()
{
    constexpr int replace = 0;
    setenv("NCCL_MAX_P2P_NCHANNELS", "4", replace);
}

class NcclLink : public GpuLink
{
public:
    explicit NcclLink(const Communicator& parts) : parts_(parts.parts()), part_(parts.part())
    {
        limitChannels();
        ncclUniqueId id{};
        if (part_ == 0) check(ncclGetUniqueId(&id), "begin");
        id_ = parts.gather(id)[0];
    }

    // Where this part has failed it does not wait for the others.
    ~NcclLink() override
    {
        if (!communicator_) return;
        if (std::uncaught_exceptions() > 0) ncclCommAbort(communicator_);
        else ncclCommDestroy(communicator_);
    }

    NcclLink(const NcclLink&) = delete;
    NcclLink& operator=(const NcclLink&) = delete;

    std::string name() const override
    {
        int version = 0;
        ncclGetVersion(&version);
        return "NCCL " + std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." + std::to_string(version % 100);
    }

    void start() override { check(ncclCommInitRank(&communicator_, parts_, id_, part_), "link the GPUs"); }

    void exchange(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received, void* stream) const override
    {
        const auto turn = static_cast<cudaStream_t>(stream);
        if (sent.empty() && received.empty()) return;
        check(ncclGroupStart(), "begin an exchange");
        for (const SentPiece& piece : sent) check(ncclSend(piece.bytes, piece.size, ncclInt8, piece.part, communicator_, turn), "send");
        for (const ReceivedPiece& piece : received) check(ncclRecv(piece.bytes, piece.size, ncclInt8, piece.part, communicator_, turn), "receive");
        check(ncclGroupEnd(), "exchange");
    }

private:
    int parts_, part_;
    ncclUniqueId id_;
    ncclComm_t communicator_ = nullptr;
};

}

}

extern "C" shizuku::GpuLink* openNccl(const shizuku::Communicator& parts)
{
    return new shizuku::NcclLink(parts);
}
