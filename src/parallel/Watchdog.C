// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/Watchdog.H"

#include "core/messages/Error.H"
#include "parallel/CallPlace.H"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

namespace shizuku
{

namespace
{

using namespace std::chrono_literals;

CallPlace placeOfWatched;
std::atomic<bool> placeIsKnown = false;

int signalOfWatchdog() { return SIGRTMIN + 7; }

extern "C" void tellPlace(int)
{
    placeOfWatched = CallPlace::here();
    placeIsKnown = true;
}

}

double Watchdog::limit()
{
    constexpr double usual = 300;
    const char* const text = std::getenv("SHIZUKU_WAIT_LIMIT");
    if (!text || !*text) return usual;
    char* end = nullptr;
    const double value = std::strtod(text, &end);
    if (*end == '\0' && value >= 0) return value;
    throw FatalError(std::string("SHIZUKU_WAIT_LIMIT is '") + text + "', and has to be seconds, 0 for no limit");
}

Watchdog::Watchdog(Slot* slots, int ofHost, int own, int part, int parts)
:
    slots_(slots),
    ofHost_(ofHost),
    own_(own),
    part_(part),
    parts_(parts),
    limit_(std::int64_t(1000 * limit())),
    watched_(pthread_self())
{
    if (limit_ == 0) return;
    placeOfWatched = CallPlace::here();             // what is loaded for it is loaded by now
    struct sigaction action{};
    action.sa_handler = tellPlace;
    action.sa_flags = SA_RESTART;
    sigaction(signalOfWatchdog(), &action, nullptr);
    thread_ = std::thread([this] { watch(); });
}

Watchdog::~Watchdog()
{
    over_ = true;
    slots_[own_].since = now();                     // for the others' end
    slots_[own_].state = hasEnded;
    if (thread_.joinable()) thread_.join();
}

void Watchdog::watch()
{
    const auto pause = std::chrono::milliseconds(std::min<std::int64_t>(1000, std::max<std::int64_t>(limit_ / 4, 1)));
    constexpr auto step = 20ms;                     // a run that ends does not wait for long
    for (std::int64_t looked = now();; looked = now())
    {
        for (auto slept = 0ms; slept < pause; slept += step)
        {
            if (over_) return;
            std::this_thread::sleep_for(step);
        }
        constexpr std::int64_t stopped = 5000;      // ms: a job that a batch system suspends has not waited meanwhile
        if (now() - looked > pause.count() + stopped) resumed_ = now();
        if (!isStuck()) continue;
        say();
        slots_[own_].state = hasSaid;
        const auto end = std::chrono::steady_clock::now() + 3s;
        const auto allHaveSaid = [&]
        {
            for (int k = 0; k < ofHost_; ++k) if (slots_[k].state < hasSaid) return false;
            return true;
        };
        while (!allHaveSaid() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(step);
        std::_Exit(EXIT_FAILURE);
    }
}

// Where one of the host's processes has found so, the others say where they are as well.
bool Watchdog::isStuck() const
{
    const std::int64_t at = now();
    bool doAllWait = true, isOver = false;
    for (int k = 0; k < ofHost_; ++k)
    {
        const std::int64_t since = slots_[k].since;
        doAllWait &= since > 0 && at - std::max(since, resumed_) > limit_;
        isOver |= slots_[k].state == ends || slots_[k].state == hasSaid;
    }
    constexpr int patience = 10;
    const std::int64_t own = slots_[own_].since;
    const bool isLong = own > 0 && at - std::max(own, resumed_) > patience * limit_;
    return isOver || isLong || (doAllWait && ofHost_ == parts_);
}

void Watchdog::say() const
{
    const std::int64_t since = slots_[own_].since;
    const char* const what = what_;
    slots_[own_].state = ends;
    std::ostringstream text;
    text << "\n--> FATAL ERROR:\nPart " << part_ << " of " << parts_;
    if (since > 0) text << " has waited " << double(now() - since) / 1000 << " s in " << (what ? what : "a wait");
    else text << " does not wait for others: it computes, or waits for its device";
    pthread_kill(watched_, signalOfWatchdog());
    for (int k = 0; k < 50 && !placeIsKnown; ++k) std::this_thread::sleep_for(20ms);
    if (placeIsKnown) text << ", called from" << placeOfWatched.text(12);
    for (int k = 0; k < ofHost_; ++k) if (slots_[k].state == hasEnded) text << "\n    Process " << k << " of this host has come to its end.";
    text << "\n    Parts that wait for each other for longer than a step can take never go on, so the run ends. SHIZUKU_WAIT_LIMIT sets the limit, in seconds.\n";
    std::fputs(text.str().c_str(), stderr);
    std::fflush(stderr);
}

}
