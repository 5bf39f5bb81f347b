// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseRuns/RunningCase.H"

#include "core/messages/Error.H"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>
#include <vector>

extern char** environ;

namespace shizuku
{

namespace
{

constexpr std::chrono::milliseconds interval{20};

int openLog(const std::filesystem::path& casePath)
{
    const std::filesystem::path file = casePath/"log.runCases";
    const int log = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (log < 0) throw FatalError("Cannot write " + file.string() + ": " + std::strerror(errno));
    if (::flock(log, LOCK_EX | LOCK_NB) == 0) return log;
    ::close(log);
    throw FatalError("The case is being run already: a program that an earlier runCases started writes " + file.string());
}

std::vector<std::string> environmentWith(const std::map<std::string, std::string>& added)
{
    std::vector<std::string> result;
    for (char** entry = environ; *entry; ++entry)
    {
        const std::string text = *entry;
        if (!added.contains(text.substr(0, text.find('=')))) result.push_back(text);
    }
    for (const auto& [name, value] : added) result.push_back(name + "=" + value);
    return result;
}

// Waits for a word, or for the end of who would say it.
bool hasWord(int stream)
{
    char word = 0;
    ssize_t count = 0;
    while ((count = ::read(stream, &word, 1)) < 0 && errno == EINTR) {}
    return count > 0;
}

// Waits for the end of who holds the lifeline's other end; where no word came before, ends the group. Only system calls.
[[noreturn]] void guard(int lifeline, pid_t group)
{
    ::setpgid(0, group);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_IGN);
    if (hasWord(lifeline)) ::_exit(0);
    ::kill(-group, SIGTERM);
    ::sleep(5);
    ::kill(-group, SIGKILL);
    ::_exit(0);
}

// Its id; -1 where none can be started, which leaves the case unguarded.
pid_t startGuard(const int (&lifeline)[2], pid_t group)
{
    const pid_t id = ::fork();
    if (id != 0) return id;
    const int nothing = ::open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, stream);
    ::dup2(lifeline[0], 3);
    ::close_range(4, ~0u, 0);
    guard(3, group);
}

}

RunningCase::RunningCase
(
    const std::filesystem::path& casePath, const std::string& command,
    const std::map<std::string, std::string>& environment
)
{
    // All memory is taken before the fork: behind it only system calls are safe.
    std::vector<std::string> texts = environmentWith(environment);
    std::vector<char*> variables;
    for (std::string& text : texts) variables.push_back(text.data());
    variables.push_back(nullptr);
    const char* const arguments[] = {"sh", "-c", command.c_str(), nullptr};

    const int log = openLog(casePath);
    int go[2] = {-1, -1};       // the command waits for its guard: where this program is killed before that, neither starts
    id_ = ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, go) == 0 ? ::fork() : -1;
    if (id_ == 0)
    {
        ::setpgid(0, 0);
        ::close(go[1]);
        if (!hasWord(go[0])) ::_exit(127);
        ::signal(SIGINT, SIG_DFL);
        ::signal(SIGTERM, SIG_DFL);
        const int input = ::open("/dev/null", O_RDONLY);
        ::dup2(input, STDIN_FILENO);
        ::dup2(log, STDOUT_FILENO);
        ::dup2(log, STDERR_FILENO);
        if (::chdir(casePath.c_str()) == 0) ::execve("/bin/sh", const_cast<char* const*>(arguments), variables.data());
        ::_exit(127);
    }
    const int error = errno;
    ::close(log);
    if (id_ > 0)
    {
        ::setpgid(id_, id_);    // here too: whoever comes first
        startGuarding();
        ::send(go[1], "", 1, MSG_NOSIGNAL);
    }
    for (const int end : go) ::close(end);
    if (id_ < 0) throw FatalError(std::string("Cannot start another process: ") + std::strerror(error));
}

void RunningCase::startGuarding()
{
    int lifeline[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, lifeline) != 0) return;
    guard_ = startGuard(lifeline, id_);
    ::close(lifeline[0]);
    lifeline_ = lifeline[1];
}

void RunningCase::dismissGuard()
{
    if (lifeline_ >= 0)
    {
        ::send(lifeline_, "", 1, MSG_NOSIGNAL);     // a guard that was killed with the case hears nothing
        ::close(lifeline_);
    }
    if (guard_ > 0) ::waitpid(guard_, nullptr, 0);
    lifeline_ = guard_ = -1;
}

RunningCase::~RunningCase()
{
    stop();
}

bool RunningCase::isBeingRun(const std::filesystem::path& casePath)
{
    const int log = ::open((casePath/"log.runCases").c_str(), O_WRONLY | O_CLOEXEC);
    if (log < 0) return false;
    const bool locked = ::flock(log, LOCK_EX | LOCK_NB) != 0;
    ::close(log);
    return locked;
}

bool RunningCase::ended()
{
    int status = 0;
    if (ended_ || ::waitpid(id_, &status, WNOHANG) != id_) return ended_;
    ended_ = true;
    dismissGuard();
    end_ = Clock::now();
    exit_ = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    return true;
}

double RunningCase::seconds() const
{
    return std::chrono::duration<double>((ended_ ? end_ : Clock::now()) - start_).count();
}

void RunningCase::askToEnd()
{
    if (!ended()) ::kill(-id_, SIGTERM);
}

void RunningCase::stop()
{
    if (ended()) return;
    askToEnd();
    const auto patience = Clock::now() + std::chrono::seconds(5);
    while (!ended() && Clock::now() < patience) std::this_thread::sleep_for(interval);
    ::kill(-id_, SIGKILL);      // what is left of the group
    if (!ended_) ::waitpid(id_, nullptr, 0);
    ended_ = true;
    dismissGuard();
}

}
