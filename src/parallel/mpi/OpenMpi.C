// SPDX-License-Identifier: GPL-3.0-or-later
// Parts as processes that mpirun has started. A library of its own, which is opened where -parallel asks for it: nothing else is linked to MPI.
//
// Messages of which both sides know the size go straight between those who have something for each other; of others the sizes go first, from all to all.

#include "parallel/ParallelRun.H"
#include "parallel/Watchdog.H"

#include <fcntl.h>
#include <mpi.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

namespace shizuku
{

namespace
{

constexpr std::size_t mostBytes = std::size_t(1) << 30;        // of a message: MPI counts in int
constexpr int tag = 1;

// Calls message(first byte, how many) for as many messages as a piece needs.
template<class Message>
void inMessages(std::size_t size, const Message& message)
{
    for (std::size_t first = 0; first < size; first += mostBytes) message(first, int(std::min(mostBytes, size - first)));
}

// Memory that the processes of a host share, zero at first. It has no name once all have it.
class SharedMemory
{
public:
    SharedMemory(MPI_Comm host, std::size_t size) : size_(size)
    {
        int part, creator = int(getpid());
        MPI_Comm_rank(host, &part);
        MPI_Bcast(&creator, 1, MPI_INT, 0, host);
        const std::string name = "/shizuku." + std::to_string(creator);
        int file = -1;
        if (part == 0)
        {
            file = shm_open(name.c_str(), O_CREAT | O_EXCL | O_RDWR, 0600);
            if (file >= 0 && ftruncate(file, off_t(size)) != 0) file = -1;
        }
        MPI_Barrier(host);
        if (part > 0) file = shm_open(name.c_str(), O_RDWR, 0600);
        if (file >= 0)
        {
            memory_ = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
            close(file);
        }
        MPI_Barrier(host);
        if (part == 0) shm_unlink(name.c_str());
        int have = memory_ != MAP_FAILED, all;
        MPI_Allreduce(&have, &all, 1, MPI_INT, MPI_MIN, host);
        haveAll_ = all;
    }

    ~SharedMemory() { if (memory_ != MAP_FAILED) munmap(memory_, size_); }

    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    // Whether each process has it.
    bool isThere() const { return haveAll_; }
    void* get() const { return memory_; }

private:
    std::size_t size_;
    void* memory_ = MAP_FAILED;
    bool haveAll_ = false;
};

class Processes : public Communicator
{
public:
    Processes()
    {
        MPI_Comm_rank(MPI_COMM_WORLD, &part_);
        MPI_Comm_size(MPI_COMM_WORLD, &parts_);
        MPI_Comm host;
        int ofHost;
        MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, part_, MPI_INFO_NULL, &host);
        MPI_Comm_rank(host, &partOfHost_);
        MPI_Comm_size(host, &ofHost);
        slots_ = std::make_unique<SharedMemory>(host, ofHost * sizeof(Watchdog::Slot));
        MPI_Comm_free(&host);
        // Without memory in common a process knows of itself alone.
        const bool isShared = slots_->isThere();
        Watchdog::Slot* const slots = isShared ? static_cast<Watchdog::Slot*>(slots_->get()) : &alone_;
        watchdog_ = std::make_unique<Watchdog>(slots, isShared ? ofHost : 1, isShared ? partOfHost_ : 0, part_, parts_);
    }

    int part() const override { return part_; }
    int parts() const override { return parts_; }
    int partOfHost() const override { return partOfHost_; }

    std::vector<Bytes> exchange(std::vector<Bytes> to) const override
    {
        using Size = unsigned long long;
        std::vector<Size> give(parts_), take(parts_);
        for (int k = 0; k < parts_; ++k) give[k] = to[k].size();
        std::vector<Bytes> from(parts_);
        const Watchdog::Wait waits(*watchdog_, "an exchange of messages between all");
        MPI_Alltoall(give.data(), 1, MPI_UNSIGNED_LONG_LONG, take.data(), 1, MPI_UNSIGNED_LONG_LONG, MPI_COMM_WORLD);
        std::vector<SentPiece> sent;
        std::vector<ReceivedPiece> received;
        for (int k = 0; k < parts_; ++k)
        {
            if (k == part_) continue;
            from[k].resize(take[k]);
            sent.push_back({k, to[k].data(), to[k].size()});
            received.push_back({k, from[k].data(), from[k].size()});
        }
        begin(sent, received);
        waitForMessages();
        from[part_] = std::move(to[part_]);
        return from;
    }

    void exchange(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received) const override
    {
        begin(sent, received);
        end();
    }

    void begin(const std::vector<SentPiece>& sent, const std::vector<ReceivedPiece>& received) const override
    {
        requests_.clear();
        for (const ReceivedPiece& piece : received)
        {
            inMessages(piece.size, [&](std::size_t first, int size)
            {
                MPI_Irecv(piece.bytes + first, size, MPI_BYTE, piece.part, tag, MPI_COMM_WORLD, &requests_.emplace_back());
            });
        }
        for (const SentPiece& piece : sent)
        {
            inMessages(piece.size, [&](std::size_t first, int size)
            {
                MPI_Isend(piece.bytes + first, size, MPI_BYTE, piece.part, tag, MPI_COMM_WORLD, &requests_.emplace_back());
            });
        }
    }

    void end() const override
    {
        const Watchdog::Wait waits(*watchdog_, "an exchange of pieces with its neighbours");
        waitForMessages();
    }

    void gather(const void* own, std::size_t size, void* all) const override
    {
        const Watchdog::Wait waits(*watchdog_, "a gather of all");
        MPI_Allgather(own, int(size), MPI_BYTE, all, int(size), MPI_BYTE, MPI_COMM_WORLD);
    }

private:
    void waitForMessages() const { MPI_Waitall(int(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE); }

    int part_ = 0, parts_ = 1, partOfHost_ = 0;
    mutable std::vector<MPI_Request> requests_;
    std::unique_ptr<SharedMemory> slots_;
    Watchdog::Slot alone_{};
    std::unique_ptr<Watchdog> watchdog_;
};

// MPI, from its start to its end.
class Session
{
public:
    Session(int* argc, char*** argv)
    {
        int provided;
        MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
        MPI_Comm_dup(MPI_COMM_WORLD, &ending_);
    }

    // MPI frees what is left: parts may still be in allCome().
    ~Session() { MPI_Finalize(); }

    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    MPI_Comm ending() const { return ending_; }

private:
    MPI_Comm ending_;           // so that its messages are no others'
};

class MpiRun : public ParallelRun
{
public:
    MpiRun(int* argc, char*** argv) : session_(argc, argv) {}

    const Communicator& parts() const override { return processes_; }

    bool allCome(double seconds) override
    {
        using Clock = std::chrono::steady_clock;
        const auto end = Clock::now() + std::chrono::duration<double>(seconds);
        MPI_Request request;
        MPI_Ibarrier(session_.ending(), &request);
        for (;;)
        {
            int have = 0;
            MPI_Test(&request, &have, MPI_STATUS_IGNORE);
            if (have) return true;
            if (Clock::now() > end) return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }

    void abort(int status) override
    {
        MPI_Abort(MPI_COMM_WORLD, status);
        std::abort();
    }

private:
    Session session_;
    Processes processes_;
};

}

}

extern "C" shizuku::ParallelRun* openMpi(int* argc, char*** argv)
{
    return new shizuku::MpiRun(argc, argv);
}
