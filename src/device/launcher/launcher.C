// The executable of a device application: opens the module of the backend that -device asks for.
//
// -device auto takes CUDA where a GPU and the module are there, the CPU otherwise. The module does all the
// rest; this file only reads the one option.

#include "core/messages/Error.H"

#include <dlfcn.h>

#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

using namespace shizuku;
namespace fs = std::filesystem;

namespace
{

using EntryPoint = int (*)(int, char**);

std::string deviceOption(int argc, char** argv)
{
    for (int i = 1; i + 1 < argc; ++i)
    {
        if (!std::strcmp(argv[i], "-device")) return argv[i + 1];
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
    if (device == "auto")
    {
        if (gpuAnswers() && fs::exists(modulePath("cuda"))) return openFor("cuda");
        return openFor("cpu");
    }
    if (device != "cuda" && device != "cpu")
    {
        throw FatalInputError
        (
            {"command line", 0}, "Unknown device '" + device + "'", "one of the devices below",
            {"auto", "cpu", "cuda"}, device
        );
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

}

int main(int argc, char** argv)
{
    try
    {
        const auto run = reinterpret_cast<EntryPoint>(dlsym(openFor(deviceOption(argc, argv)), "runOnDevice"));
        if (!run) throw FatalError("The module of " SHIZUKU_APPLICATION " has no entry point");
        return run(argc, argv);
    }
    catch (const FatalError& error)
    {
        std::cerr << "\n--> FATAL ERROR: " << error.what() << "\n\n";
        return 1;
    }
}
