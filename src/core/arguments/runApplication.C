// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/arguments/runApplication.H"

#include "core/arguments/StopSignals.H"
#include "core/arguments/Version.H"
#include "core/messages/Error.H"

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <new>
#include <optional>
#include <sstream>

namespace shizuku
{

namespace
{

// Of the program, or of what restartClocks() has begun.
auto startTime = std::chrono::steady_clock::now();
std::clock_t startProcessor = 0;

std::string hostName()
{
    char name[256] = "";
    return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

void printBanner(const Arguments& args)
{
    const std::time_t now = std::time(nullptr);
    std::cout
        << "Shizuku " << versionText() << ", " << std::put_time(std::localtime(&now), "%b %d %Y %H:%M:%S") << ", host "
        << hostName() << ", PID " << getpid() << "\n"
        << "Exec   : " << args.commandLine() << "\n";
    if (args.info().needsCase && !args.givesCases()) std::cout << "Case   : " << args.casePath().string() << "\n";
    std::cout << std::endl;
}

int fail(const ApplicationInfo& info, const std::string& kind, const std::string& message)
{
    std::cout.flush();
    std::cerr.clear();          // an earlier line may have found no room
    std::cerr << "\n--> " << kind << ":\n" << message << "\n\n" << info.name << ": stopped\n";
    return EXIT_FAILURE;
}

// By the signal itself, or where that is held back with the status that a shell would give it.
int endBySignal(const ApplicationInfo& info, const Interruption& interruption)
{
    std::cout.flush();
    std::cerr << "\n" << info.name << ": stopped by " << interruption.name() << std::endl;
    ::signal(interruption.signal, SIG_DFL);
    ::raise(interruption.signal);
    return 128 + interruption.signal;
}

// The exit status of what it calls: errors are printed.
int statusOf(const ApplicationInfo& info, const std::function<void()>& call)
{
    try
    {
        call();
        return EXIT_SUCCESS;
    }
    catch (const Interruption& interruption)
    {
        return endBySignal(info, interruption);
    }
    catch (const FatalInputError& error)
    {
        return fail(info, "FATAL IO ERROR", error.what());
    }
    catch (const std::bad_alloc&)
    {
        return fail(info, "FATAL ERROR", "There is not enough memory");
    }
    catch (const std::exception& error)
    {
        return fail(info, "FATAL ERROR", error.what());
    }
}

}

int runApplication
(
    int argc, const char* const* argv, const ApplicationInfo& info,
    const std::function<void(const Arguments&)>& body, bool quiet
)
{
    std::optional<Arguments> args;
    const int status = statusOf(info, [&] { args.emplace(argc, argv, info); });
    return args ? runApplication(*args, body, quiet) : status;
}

int runApplication(const Arguments& args, const std::function<void(const Arguments&)>& body, bool quiet)
{
    std::signal(SIGXFSZ, SIG_IGN);      // a file that would be too large is an error of the write, with its message
    return statusOf(args.info(), [&]
    {
        if (!quiet) printBanner(args);
        body(args);
        if (!quiet) std::cout << "\n" << executionTime() << "\n\nEnd\n";
        if (!std::cout.flush()) throw FatalError("The standard output cannot be written");
    });
}

std::string versionText() { return SHIZUKU_VERSION "-" SHIZUKU_COMMIT; }

void restartClocks()
{
    startTime = std::chrono::steady_clock::now();
    startProcessor = std::clock();
}

double clockTime()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - startTime).count();
}

std::string executionTime()
{
    const double processor = static_cast<double>(std::clock() - startProcessor) / CLOCKS_PER_SEC;
    std::ostringstream text;
    text
        << std::fixed << std::setprecision(2) << "ExecutionTime = " << processor << " s  ClockTime = "
        << long(clockTime()) << " s";
    return text.str();
}

}
