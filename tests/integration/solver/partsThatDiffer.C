// SPDX-License-Identifier: GPL-3.0-or-later
// What TestParallel runs: mpirun -np 2 partsThatDiffer -parallel <how>. Parts that do not come to the same calls, or that let each other wait.

#include "core/messages/Error.H"
#include "parallel/AllParts.H"
#include "parallel/ParallelRun.H"

#include <chrono>
#include <iostream>
#include <string>
#include <thread>

using namespace shizuku;

namespace
{

void differ(const Communicator& parts, const std::string& how)
{
    parts.any(true);
    const bool isFirst = parts.part() == 0;
    if (how == "branches")
    {
        if (isFirst) gatherTexts(parts, "of the first");
        else inAllParts(parts, [] {});
    }
    else if (how == "ends")
    {
        if (isFirst) gatherTexts(parts, "of the first");
    }
    else if (how == "works")            // for longer than the limit, which is no fault
    {
        if (isFirst) std::this_thread::sleep_for(std::chrono::seconds(4));
        parts.any(true);
    }
}

}

int main(int argc, char** argv)
{
    return runInParts(argc, argv, [&](const Communicator& parts)
    {
        try
        {
            differ(parts, argv[argc - 1]);
        }
        catch (const FatalError& error)
        {
            std::cerr << error.what() << std::endl;
            return 1;
        }
        return 0;
    });
}
