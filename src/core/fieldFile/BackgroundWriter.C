// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/BackgroundWriter.H"

#include "core/messages/Error.H"

#include <chrono>
#include <exception>
#include <utility>

namespace shizuku
{

BackgroundWriter::~BackgroundWriter()
{
    try
    {
        finish();
    }
    catch (const std::exception& error)
    {
        warning(error.what());
    }
}

void BackgroundWriter::start()
{
    if (isIdle() || !added_.empty()) wait();
    if (added_.empty()) return;
    underWay_ = std::async(std::launch::async, [jobs = std::exchange(added_, {})]
    {
        for (const WriteJob& job : jobs) job();
    });
}

bool BackgroundWriter::isIdle() const
{
    using namespace std::chrono_literals;
    return !underWay_.valid() || underWay_.wait_for(0s) == std::future_status::ready;
}

void BackgroundWriter::finish()
{
    start();
    wait();
}

void BackgroundWriter::wait()
{
    if (!underWay_.valid()) return;
    const auto begin = std::chrono::steady_clock::now();
    underWay_.wait();
    waited_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    try
    {
        underWay_.get();
    }
    catch (...)
    {
        added_.clear();
        throw;
    }
}

}
