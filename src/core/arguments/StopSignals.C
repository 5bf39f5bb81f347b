// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/arguments/StopSignals.H"

#include <signal.h>

#include <atomic>

namespace shizuku
{

namespace
{

constexpr int signals[] = {SIGINT, SIGTERM};

std::atomic<int> noted = 0;                         // without a lock, as a handler asks for
static_assert(std::atomic<int>::is_always_lock_free);

bool isIgnored(int signal)
{
    struct sigaction action = {};
    return ::sigaction(signal, nullptr, &action) == 0 && !(action.sa_flags & SA_SIGINFO) && action.sa_handler == SIG_IGN;
}

void handle(int signal, void (*handler)(int))
{
    if (isIgnored(signal)) return;
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;                   // what is being written is written on
    ::sigemptyset(&action.sa_mask);
    for (const int other : signals) ::sigaddset(&action.sa_mask, other);
    ::sigaction(signal, &action, nullptr);
}

// A second one may come to another thread while this runs: then it ends the run as soon as its handler does.
void note(int signal)
{
    const bool isSecond = noted.exchange(signal) != 0;
    for (const int each : signals) handle(each, SIG_DFL);
    if (isSecond) ::raise(signal);
}

}

std::string Interruption::name() const
{
    return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "signal " + std::to_string(signal);
}

StopSignals::StopSignals()
{
    noted = 0;
    for (const int signal : signals) handle(signal, note);
}

StopSignals::~StopSignals()
{
    for (const int signal : signals) handle(signal, SIG_DFL);
}

Interruption StopSignals::received() const
{
    return {noted};
}

void StopSignals::endIfReceived() const
{
    if (const Interruption interruption = received(); interruption.signal != 0) throw interruption;
}

}
