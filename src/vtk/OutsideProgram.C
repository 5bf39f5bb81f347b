// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/OutsideProgram.H"

#include "core/messages/Error.H"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace shizuku
{

int runOutsideProgram(const std::string& program, const std::vector<std::string>& arguments, const std::filesystem::path& log)
{
    const pid_t child = fork();
    if (child < 0) throw FatalError(program + " cannot be started: no process can be made");
    if (child == 0)
    {
        const int in = open("/dev/null", O_RDONLY), out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        dup2(in, STDIN_FILENO);
        dup2(out, STDOUT_FILENO);
        dup2(out, STDERR_FILENO);
        std::vector<char*> words{const_cast<char*>(program.c_str())};
        for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
        words.push_back(nullptr);
        execvp(program.c_str(), words.data());
        _exit(127);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}
