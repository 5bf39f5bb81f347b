// The executable of a device application: opens the module of the backend that -device asks for.
//
// -device auto takes CUDA where a GPU and the module are there, the CPU otherwise. The module does all the
// rest; this file only reads the one option, in the forms that core/arguments takes it.

#include "core/messages/Error.H"

#include <dlfcn.h>

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

// The word behind -device or --device, or glued to it by '='.
std::string deviceOption(int argc, char** argv)
{
    const std::string name = "-device";
    for (int i = 1; i < argc; ++i)
    {
        std::string token = argv[i];
        if (token.starts_with("--")) token.erase(0, 1);
        if (token == name && i + 1 < argc) return argv[i + 1];
        if (token.starts_with(name + "=")) return token.substr(name.size() + 1);
    }
    return "auto";
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

void* openFor(const std::string& device)
{
    // What is no device at all is refused by the application, like every wrong option.
    if (device != "cuda" && device != "cpu")
    {
        const bool gpu = device == "auto" && fs::exists(modulePath("cuda")) && gpuAnswers();
        return openFor(gpu ? "cuda" : "cpu");
    }
    if (!fs::exists(modulePath(device)))
    {
        throw FatalError
        (
            "Device '" + device + "' was asked for but this installation was built without it: "
          + modulePath(device).string() + " is absent.\n    Install the CUDA toolkit and build again, or use -device cpu."
        );
    }
    void* module = open(device);
    if (!module) throw FatalError("Cannot open " + modulePath(device).string() + ": " + dlerror());
    return module;
}

// Threads of the CPU backend that wait for the others shall soon sleep: spinning ones starve them where cores are shared.
// Ten thousand turns outlast the gaps inside of a step. What the user set stays.
void letWaitingThreadsSleep()
{
    setenv("GOMP_SPINCOUNT", "10000", 0);
}

}

int main(int argc, char** argv)
{
    try
    {
        letWaitingThreadsSleep();
        const auto run = reinterpret_cast<EntryPoint>(dlsym(openFor(deviceOption(argc, argv)), "runOnDevice"));
        if (!run) throw FatalError("The module of " SHIZUKU_APPLICATION " has no entry point");
        return run(argc, argv);
    }
    catch (const FatalError& error)
    {
        std::cerr << "\n--> FATAL ERROR:\n" << error.what() << "\n\n" SHIZUKU_APPLICATION ": stopped\n";
        return EXIT_FAILURE;
    }
}
