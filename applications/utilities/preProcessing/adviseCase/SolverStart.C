// SPDX-License-Identifier: GPL-3.0-or-later
#include "SolverStart.H"

#include "advice/TimedCall.H"
#include "core/messages/Error.H"

namespace shizuku
{

SolverStart startSolver(const TrialCase& trial, const std::vector<std::string>& backend, double calledFor)
{
    const TrialCase ended(trial.path(), {{"system/controlDict", "stopAt", "noWriteNow"}});
    const auto programs = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    std::vector<std::string> command{(programs/"pbfDroplet").string(), "-case", ended.path().string()};
    command.insert(command.end(), backend.begin(), backend.end());
    if (trial.withoutSolid()) command.push_back("-noFunctionObjects");
    try
    {
        return {secondsOfCall(command, ended.path()/"log.pbfDroplet", calledFor), {}};
    }
    catch (const FatalError& error)
    {
        return {{}, error.what()};
    }
}

}
