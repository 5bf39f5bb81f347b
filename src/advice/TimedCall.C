// SPDX-License-Identifier: GPL-3.0-or-later
#include "advice/TimedCall.H"

#include "core/dictionary/DictionaryExpansion.H"
#include "core/messages/Error.H"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>

extern char** environ;

namespace shizuku
{

namespace
{

// Its standard streams on a log.
class Redirection
{
public:
    explicit Redirection(const std::string& log)
    {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
        posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
    }
    ~Redirection() { posix_spawn_file_actions_destroy(&actions_); }
    Redirection(const Redirection&) = delete;
    Redirection& operator=(const Redirection&) = delete;

    const posix_spawn_file_actions_t* actions() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_;
};

// Returns its status as waitpid has it.
int call(const std::vector<std::string>& command, const Redirection& redirection)
{
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_t id;
    const int error = posix_spawn(&id, command.front().c_str(), redirection.actions(), nullptr, arguments.data(), environ);
    if (error != 0) throw FatalError("Cannot start " + command.front() + ": " + std::strerror(error));
    int status = 0;
    while (waitpid(id, &status, 0) < 0)
    {
        if (errno != EINTR) throw FatalError("Cannot wait for " + command.front() + ": " + std::strerror(errno));
    }
    return status;
}

// What it says of itself behind the last arrow of an error; else all that it printed.
std::string reason(const std::filesystem::path& log)
{
    std::string text = readText(log);
    const std::size_t arrow = text.rfind("-->");
    if (arrow != std::string::npos) text.erase(0, arrow);
    text.erase(text.find_last_not_of(" \n") + 1);
    return text;
}

}

double secondsOfCall(const std::vector<std::string>& command, const std::filesystem::path& log, double calledFor)
{
    using Clock = std::chrono::steady_clock;
    constexpr std::size_t most = 5;
    const Redirection redirection(log.string());
    std::vector<double> seconds;
    double sum = 0;
    do
    {
        const auto begun = Clock::now();
        const int status = call(command, redirection);
        seconds.push_back(std::chrono::duration<double>(Clock::now() - begun).count());
        sum += seconds.back();
        if (status != 0) throw FatalError(command.front() + " stopped:\n" + reason(log));
    }
    while (sum + seconds.back() < calledFor && seconds.size() < most);
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size()/2];
}

}
