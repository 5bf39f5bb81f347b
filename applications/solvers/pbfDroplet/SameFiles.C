// SPDX-License-Identifier: GPL-3.0-or-later
#include "SameFiles.H"

#include "core/dictionary/Differences.H"
#include "core/messages/Error.H"

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>
#include <sstream>
#include <thread>

namespace shizuku
{

namespace
{

struct Read
{
    std::size_t digest = 0;
    bool failed = false;

    bool operator==(const Read&) const = default;
};

}

void readTheSame(const Communicator& parts, const std::function<std::string()>& read)
{
    using namespace std::chrono_literals;
    const auto end = std::chrono::steady_clock::now() + 30s;
    for (auto pause = 1ms;; pause = std::min(2 * pause, 100ms))
    {
        Read own;
        std::exception_ptr failure;
        try
        {
            own.digest = std::hash<std::string>()(read());
        }
        catch (const FatalInputError&)
        {
            failure = std::current_exception();
            own.failed = true;
        }
        const std::vector<Read> all = parts.gather(own);
        const bool same = std::all_of(all.begin(), all.end(), [&](const Read& each) { return each == all.front(); });
        if (same && failure) std::rethrow_exception(failure);
        if (same) return;
        if (parts.any(std::chrono::steady_clock::now() > end)) break;
        std::this_thread::sleep_for(pause);
    }
    throw FatalError("The parts of the run do not read the same in the case's dictionaries, which have changed");
}

std::string textOf(const Dictionary& dict)
{
    std::ostringstream text;
    for (const EntryChange& entry : differences(Dictionary(), dict)) text << entry.entry << ' ' << entry.after << '\n';
    return text.str();
}

bool readIfModified(Time& time, const Communicator& parts)
{
    if (!parts.any(time.modified())) return false;
    std::optional<Time::ControlDict> now;
    try
    {
        readTheSame(parts, [&]
        {
            time.modified();                    // what is changed from here on is seen in the next step
            now = time.readControlDict();
            return textOf(now->dict) + textOf(now->checked);
        });
    }
    catch (const FatalInputError& error)
    {
        Time::leaveOut(error);
        return false;
    }
    time.follow(*now);
    return true;
}

}
