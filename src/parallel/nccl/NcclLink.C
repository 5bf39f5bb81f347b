// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/nccl/NcclLink.H"

#include <nccl.h>

#include <exception>
#include <future>
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

// NCCL takes its time to start, and for its first exchange: both are made while the program goes on to its own first one.
class NcclLink : public GpuLink
{
public:
    explicit NcclLink(const Communicator& parts)
    {
        ncclUniqueId id{};
        if (parts.part() == 0) check(ncclGetUniqueId(&id), "begin");
        id = parts.gather(id)[0];
        int gpu = 0;
        cudaGetDevice(&gpu);
        started_ = std::async(std::launch::async, [=, of = parts.parts(), part = parts.part()]
        {
            cudaSetDevice(gpu);
            ncclComm_t communicator = nullptr;
            check(ncclCommInitRank(&communicator, of, id, part), "link the GPUs");
            passOn(communicator, of, part);
            return communicator;
        });
    }

    // Where this part has failed it does not wait for the others.
    ~NcclLink() override
    {
        try
        {
            if (std::uncaught_exceptions() > 0) ncclCommAbort(communicator());
            else ncclCommDestroy(communicator());
        }
        catch (const std::runtime_error&)       // it has not started
        {
        }
    }

    NcclLink(const NcclLink&) = delete;
    NcclLink& operator=(const NcclLink&) = delete;

    std::string name() const override
    {
        int version = 0;
        ncclGetVersion(&version);
        return "NCCL " + std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." + std::to_string(version % 100);
    }

    void exchange(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received, void* stream) const override
    {
        const auto turn = static_cast<cudaStream_t>(stream);
        if (sent.empty() && received.empty()) return;
        const ncclComm_t all = communicator();
        check(ncclGroupStart(), "begin an exchange");
        for (const SentPiece& piece : sent) check(ncclSend(piece.bytes, piece.size, ncclInt8, piece.part, all, turn), "send");
        for (const ReceivedPiece& piece : received) check(ncclRecv(piece.bytes, piece.size, ncclInt8, piece.part, all, turn), "receive");
        check(ncclGroupEnd(), "exchange");
    }

private:
    // A byte to the next part, from the one before.
    static void passOn(ncclComm_t communicator, int parts, int part)
    {
        char* bytes = nullptr;
        cudaStream_t stream = nullptr;
        cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking);
        cudaMalloc(reinterpret_cast<void**>(&bytes), 2);
        check(ncclGroupStart(), "begin an exchange");
        check(ncclSend(bytes, 1, ncclInt8, (part + 1) % parts, communicator, stream), "send");
        check(ncclRecv(bytes + 1, 1, ncclInt8, (part + parts - 1) % parts, communicator, stream), "receive");
        check(ncclGroupEnd(), "exchange");
        cudaStreamSynchronize(stream);
        cudaFree(bytes);
        cudaStreamDestroy(stream);
    }

    ncclComm_t communicator() const
    {
        if (started_.valid()) communicator_ = started_.get();
        return communicator_;
    }

    mutable std::future<ncclComm_t> started_;
    mutable ncclComm_t communicator_ = nullptr;
};

}

}

extern "C" shizuku::GpuLink* openNccl(const shizuku::Communicator& parts)
{
    return new shizuku::NcclLink(parts);
}
