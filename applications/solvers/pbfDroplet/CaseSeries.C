// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseSeries.H"

#include "core/arguments/StopSignals.H"
#include "core/arguments/runApplication.H"
#include "core/messages/Error.H"
#include "core/messages/Progress.H"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <utility>
#include <vector>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

// While it lives, std::cout and std::cerr go there.
class OutputTo
{
public:
    explicit OutputTo(std::ostream& there) : out_(std::cout.rdbuf(there.rdbuf())), error_(std::cerr.rdbuf(there.rdbuf())) {}
    ~OutputTo()
    {
        std::cout.flush();
        std::cout.rdbuf(out_);
        std::cerr.rdbuf(error_);
    }
    OutputTo(const OutputTo&) = delete;
    OutputTo& operator=(const OutputTo&) = delete;

private:
    std::streambuf* out_;
    std::streambuf* error_;
};

void refuseOptionsOfOneRun(const Arguments& args)
{
    for (const char* name : {"parallel", "view", "viewAt"})
    {
        if (args.found(name)) throw FatalInputError({}, std::string("Option -") + name + " is given beside cases", "it with a single case, by -case DIR");
    }
}

// The exit status of one, and its seconds.
std::pair<int, double> runOne(const Arguments& args, const fs::path& path, const std::function<void(const Arguments&)>& run)
{
    const fs::path file = path/("log." + args.info().name);
    std::ofstream log(file, std::ios::app);
    if (!log)
    {
        std::cerr << "Cannot write " << file.string() << '\n';
        return {EXIT_FAILURE, 0};
    }
    const OutputTo itsLog(log);
    restartClocks();
    const int status = runApplication(args.ofCase(path), run);
    return {status, clockTime()};
}

}

void runSeries(const Arguments& args, const std::function<void(const Arguments&)>& run)
{
    refuseOptionsOfOneRun(args);
    const std::vector<std::string> names = args.positionals("cases...");
    Progress progress("Cases");
    std::size_t done = 0, failed = 0;
    for (const std::string& name : names)
    {
        std::cout << "Started  " << name << std::endl;
        const auto [status, seconds] = runOne(args, fs::canonical(name), run);
        if (status > 128) throw Interruption{status - 128};
        ++done;
        failed += status != 0;
        std::cout << progress.ended(name, status == 0, seconds, done, names.size()) << std::endl;
    }
    if (failed == 0) return;
    throw FatalError(std::to_string(failed) + " of " + std::to_string(names.size()) + " cases failed; what each printed is in its log." + args.info().name);
}

}
