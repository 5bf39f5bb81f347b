// SPDX-License-Identifier: GPL-3.0-or-later
// The executable of a device application: opens the module of the backend that -device and -precision ask for.
//
// -device auto takes CUDA where a GPU and the module are there, the CPU otherwise; double precision is of the CPU alone. The
// module does all the rest; this file only reads the two options, in the forms that core/arguments takes them.

#include "core/messages/Error.H"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

using namespace shizuku;
namespace fs = std::filesystem;

namespace
{

using EntryPoint = int (*)(int, char**);

// The word behind -name or --name, or glued to it by '='.
std::string option(const std::string& name, const std::string& fallback, int argc, char** argv)
{
    for (int i = 1; i < argc; ++i)
    {
        std::string token = argv[i];
        if (token.starts_with("--")) token.erase(0, 1);
        if (token == name && i + 1 < argc) return argv[i + 1];
        if (token.starts_with(name + "=")) return token.substr(name.size() + 1);
    }
    return fallback;
}

fs::path modulePath(const std::string& backend)
{
    const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
    return here.parent_path() / "lib" / ("lib" SHIZUKU_APPLICATION "-" + backend + ".so");
}

void* open(const std::string& backend)
{
    return dlopen(modulePath(backend).c_str(), RTLD_NOW | RTLD_GLOBAL);
}

// A GPU is there when its driver's library loads and counts one; asked without linking to CUDA.
bool gpuAnswers()
{
    void* driver = dlopen("libcuda.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!driver) return false;
    const auto init = reinterpret_cast<int (*)(unsigned)>(dlsym(driver, "cuInit"));
    const auto count = reinterpret_cast<int (*)(int*)>(dlsym(driver, "cuDeviceGetCount"));
    int devices = 0;
    return init && count && init(0) == 0 && count(&devices) == 0 && devices > 0;
}

// asked, e.g. "Device 'cuda'", and what to do where it is absent.
void* openBackend(const std::string& backend, const std::string& asked, const std::string& remedy)
{
    const fs::path file = modulePath(backend);
    if (!fs::exists(file))
    {
        throw FatalError
        (
            asked + " was asked for but this installation was built without it: " + file.string() + " is absent.\n    " + remedy
        );
    }
    void* module = open(backend);
    if (!module) throw FatalError("Cannot open " + file.string() + ": " + dlerror());
    return module;
}

void* openDouble(const std::string& device)
{
    if (device == "cuda")
    {
        throw FatalError
        (
            "Device 'cuda' and precision 'double' were asked for, but double precision is compiled for the CPU alone.\n"
            "    Use -device cpu, or -precision single."
        );
    }
    return openBackend("cpuDouble", "Precision 'double'", "Build it with etc/build -double, or use -precision single.");
}

void* openFor(const std::string& device, const std::string& precision)
{
    // What is no device and no precision at all is refused by the application, like every wrong option.
    if (precision == "double") return openDouble(device);
    const bool gpu = device == "cuda" || (device == "auto" && fs::exists(modulePath("cuda")) && gpuAnswers());
    const std::string backend = gpu ? "cuda" : "cpu";
    return openBackend(backend, "Device '" + backend + "'", "Install the CUDA toolkit and build again, or use -device cpu.");
}

// Threads of the CPU backend that wait for the others shall soon sleep: spinning ones starve them where cores are shared.
// Ten thousand turns outlast the gaps inside of a step. What the user set stays.
void letWaitingThreadsSleep()
{
    setenv("GOMP_SPINCOUNT", "10000", 0);
}

// A GPU's context is there sooner with as few connections as a process has streams (device/cuda/LaunchQueue.H): a tenth of a second of each start. Links between
// GPUs have streams of their own. What the user set stays.
void openFewConnections(int argc, char** argv)
{
    const auto isParallel = [](const std::string& token) { return token == "-parallel" || token == "--parallel"; };
    if (std::none_of(argv + 1, argv + argc, isParallel)) setenv("CUDA_DEVICE_MAX_CONNECTIONS", "2", 0);
}

}

int main(int argc, char** argv)
{
    try
    {
        letWaitingThreadsSleep();
        openFewConnections(argc, argv);
        const std::string device = option("-device", "auto", argc, argv), precision = option("-precision", "single", argc, argv);
        const auto run = reinterpret_cast<EntryPoint>(dlsym(openFor(device, precision), "runOnDevice"));
        if (!run) throw FatalError("The module of " SHIZUKU_APPLICATION " has no entry point");
        return run(argc, argv);
    }
    catch (const FatalError& error)
    {
        std::cerr << "\n--> FATAL ERROR:\n" << error.what() << "\n\n" SHIZUKU_APPLICATION ": stopped\n";
        return EXIT_FAILURE;
    }
}
