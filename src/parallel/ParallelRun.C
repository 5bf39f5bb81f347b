// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/ParallelRun.H"

#include "core/messages/Error.H"
#include "parallel/CheckedParts.H"
#include "parallel/Launcher.H"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <streambuf>
#include <string>

namespace shizuku
{

namespace
{

bool asksForParts(int argc, char** argv)
{
    return std::any_of(argv + 1, argv + argc, [](const std::string& word) { return word == "-parallel" || word == "--parallel"; });
}

// Started by mpirun, but each by itself.
void warnOfLonely()
{
    const auto launch = launchOf();
    if (!launch || !launch->isMpirun || launch->processes < 2) return;
    warning("mpirun has started " + std::to_string(launch->processes) + " processes, and each runs the case by itself: -parallel is missing");
}

// Of one process with -parallel: others that were started beside it would each compute the whole case.
void refuseStrangers(const std::optional<Launch>& launch, const std::string& program)
{
    const std::string several = std::to_string(launch ? std::max(launch->processes, 2) : 4), call = "mpirun -np " + several + " " + program + " -parallel";
    if (!launch) return warning("-parallel without mpirun: one process computes the whole case\n    Expected: " + call);
    if (launch->processes < 2) return;
    throw FatalError
    (
        "By " + launch->variable + " a launcher has started " + several + " processes or more, but -parallel finds this one alone: the launcher does not speak with Open MPI\n"
        "    Expected: " + call + ", in a batch job too; or a launcher that speaks PMIx, such as srun --mpi=pmix"
    );
}

std::unique_ptr<ParallelRun> open(int argc, char** argv)
{
    void* const module = dlopen("libshizukuMpi.so", RTLD_NOW | RTLD_GLOBAL);
    if (!module)
    {
        throw FatalError
        (
            "Option -parallel needs Open MPI: " + std::string(dlerror())
          + ".\n    Where libshizukuMpi.so itself is missing: of packages, install shizuku-mpi too; where Shizuku was built here, install libopenmpi-dev (etc/setup does) and build again."
        );
    }
    const auto make = reinterpret_cast<OpenParallelRun>(dlsym(module, "openMpi"));
    if (!make) throw FatalError("The module libshizukuMpi.so has no entry point");
    return std::unique_ptr<ParallelRun>(make(&argc, &argv));
}

bool areChecked()
{
    const char* const word = std::getenv("SHIZUKU_CHECK_PARTS");
    return word && *word && std::string(word) != "0";
}

int runChecked(const Communicator& parts, const std::function<int(const Communicator&)>& run)
{
    static std::optional<CheckedParts> checked;         // -help and the like end the program from within
    checked.emplace(parts);
    const int status = run(*checked);
    if (status != EXIT_SUCCESS) return status;
    try
    {
        checked->finish();
    }
    catch (const FatalError& error)
    {
        std::cerr << "\n--> FATAL ERROR:\n" << error.what() << std::endl;
        return EXIT_FAILURE;
    }
    return status;
}

// A stream that takes everything and keeps nothing.
class Nowhere : public std::streambuf
{
    int overflow(int character) override { return traits_type::not_eof(character); }
};

// As long as it lives, what a part other than the first prints goes nowhere, and its errors are kept.
class Muted
{
public:
    explicit Muted(bool is) : is_(is)
    {
        if (!is_) return;
        output_ = std::cout.rdbuf(&nowhere_);
        errors_ = std::cerr.rdbuf(&kept_);
    }

    ~Muted()
    {
        if (!is_) return;
        std::cout.rdbuf(output_);
        std::cerr.rdbuf(errors_);
    }

    Muted(const Muted&) = delete;
    Muted& operator=(const Muted&) = delete;

    std::string errors() const { return kept_.str(); }

private:
    bool is_;
    Nowhere nowhere_;
    std::stringbuf kept_;
    std::streambuf* output_ = nullptr;
    std::streambuf* errors_ = nullptr;
};

}

int runInParts(int argc, char** argv, const std::function<int(const Communicator&)>& run)
{
    if (!asksForParts(argc, argv))
    {
        warnOfLonely();
        return run(Alone());
    }
    static std::unique_ptr<ParallelRun> all;            // -help and the like end the program from within
    try
    {
        const auto launch = launchOf();                 // before MPI adds its own words to the environment
        all = open(argc, argv);
        if (all->parts().parts() == 1) refuseStrangers(launch, std::filesystem::path(argv[0]).filename().string());
    }
    catch (const FatalError& error)
    {
        std::cerr << "\n--> FATAL ERROR:\n" << error.what() << std::endl;
        return EXIT_FAILURE;
    }
    constexpr double soon = 3;          // s: parts that fail for one reason fail together
    const Communicator& parts = all->parts();
    int status;
    std::string errors;
    {
        const Muted muted(parts.part() > 0);
        status = areChecked() ? runChecked(parts, run) : run(parts);
        errors = muted.errors();
    }
    if (status == EXIT_SUCCESS || all->allCome(soon))
    {
        all.reset();
        return status;
    }
    if (parts.part() > 0) std::cerr << "\nPart " << parts.part() << " of " << parts.parts() << ":" << errors << std::flush;
    all->abort(status);
    return status;
}

}
