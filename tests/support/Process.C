// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Process.H"

#include "core/messages/Error.H"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

namespace shizuku::test
{

namespace
{

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds patience{60};        // far beyond every case here, also on a loaded machine
constexpr std::chrono::microseconds interval{200};  // well below a step, so that the middle of a write is met

}

Process::Process(const std::string& command, const std::filesystem::path& log) : id_(fork()), log_(log)
{
    if (id_ < 0) throw FatalError("Cannot start " + command);
    if (id_ > 0) return;
    for (const int signal : {SIGINT, SIGTERM}) ::signal(signal, SIG_DFL);       // which a job in the background inherits as ignored
    const int file = ::open(log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    ::execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), static_cast<char*>(nullptr));
    ::_exit(127);
}

Process::~Process()
{
    if (ended()) return;
    ::kill(id_, SIGKILL);
    ::waitpid(id_, nullptr, 0);
}

bool Process::ended()
{
    if (!ended_) ended_ = ::waitpid(id_, &status_, WNOHANG) == id_;
    return ended_;
}

bool Process::runUntil(const std::function<bool()>& condition)
{
    const auto start = Clock::now();
    while (!condition())
    {
        if (ended() || Clock::now() - start > patience) return false;
        std::this_thread::sleep_for(interval);
    }
    return !ended();
}

void Process::pause()
{
    ::kill(id_, SIGSTOP);
    int status = 0;
    ::waitpid(id_, &status, WUNTRACED);
    if (WIFSTOPPED(status)) return;
    ended_ = true;
    status_ = status;
}

void Process::resume()
{
    if (!ended_) ::kill(id_, SIGCONT);
}

void Process::send(int signal)
{
    if (!ended()) ::kill(id_, signal);
}

int Process::end(int signal)
{
    send(signal);
    return wait();
}

int Process::wait()
{
    const auto start = Clock::now();
    while (!ended())
    {
        if (Clock::now() - start > patience) return -1;
        std::this_thread::sleep_for(interval);
    }
    return WIFSIGNALED(status_) ? 128 + WTERMSIG(status_) : WEXITSTATUS(status_);
}

std::string Process::log() const
{
    std::ifstream stream(log_, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}
