// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/PartsOfProcess.H"

#include "parallel/CheckedParts.H"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace shizuku
{

namespace
{

// What all parts give each other, and whose turn it is: one thread at a time runs, up to its next exchange, so that nothing else has to know of threads.
class Table
{
public:
    explicit Table(int parts) : given_{std::vector<std::vector<Bytes>>(parts), std::vector<std::vector<Bytes>>(parts)} {}

    int parts() const { return int(given_[0].size()); }

    std::vector<Bytes> exchange(int part, int number, std::vector<Bytes> to)
    {
        auto& given = given_[number % 2];       // those before it go on to their next exchange while others still take of this one
        given[part] = std::move(to);
        endTurn(part);
        waitForTurn(part);
        std::vector<Bytes> taken;
        for (std::vector<Bytes>& from : given) taken.push_back(std::move(from[part]));
        return taken;
    }

    void waitForTurn(int part)
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return turn_ == part || left_; });
        if (left_) throw std::runtime_error("Another part of the liquid has ended");
    }

    void endTurn(int part)
    {
        const std::lock_guard lock(mutex_);
        turn_ = (part + 1) % parts();
        changed_.notify_all();
    }

    // The others shall wait no longer.
    void leave()
    {
        const std::lock_guard lock(mutex_);
        left_ = true;
        changed_.notify_all();
    }

private:
    std::vector<std::vector<Bytes>> given_[2];  // by who gives, and to whom
    std::mutex mutex_;
    std::condition_variable changed_;
    int turn_ = 0;
    bool left_ = false;
};

class PartOfProcess : public Communicator
{
public:
    using Communicator::exchange;

    PartOfProcess(Table& table, int part) : table_(table), part_(part) {}

    int part() const override { return part_; }
    int parts() const override { return table_.parts(); }
    std::vector<Bytes> exchange(std::vector<Bytes> to) const override { return table_.exchange(part_, number_++, std::move(to)); }

private:
    Table& table_;
    int part_;
    mutable int number_ = 0;                    // of the exchange
};

}

void runParts(int parts, const std::function<void(const Communicator&)>& run)
{
    Table table(parts);
    std::mutex mutex;
    std::exception_ptr first;
    const auto runOne = [&](int part)
    {
        try
        {
            table.waitForTurn(part);
            const PartOfProcess own(table, part);
            const CheckedParts checked(own);
            run(checked);
            checked.finish();
            table.endTurn(part);
        }
        catch (...)
        {
            const std::lock_guard lock(mutex);
            if (!first) first = std::current_exception();
            table.leave();
        }
    };
    std::vector<std::thread> threads;
    for (int k = 0; k < parts; ++k) threads.emplace_back(runOne, k);
    for (std::thread& thread : threads) thread.join();
    if (first) std::rethrow_exception(first);
}

}
