// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/SolverLog.H"

#include "core/dictionary/Dictionary.H"

namespace shizuku
{

std::filesystem::path solverLog(const std::filesystem::path& casePath)
{
    const Dictionary control = Dictionary::read(casePath/"system/controlDict");
    return casePath/("log." + control.lookupOr("application", std::string("pbfDroplet")));
}

}
