// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel/CallPlace.H"

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <sstream>

namespace shizuku
{

namespace
{

struct Frame
{
    std::string library, function;      // function: empty where the library does not tell
    std::uintptr_t offset = 0;          // of the call in the library
};

Frame frameOf(const void* returnAddress)
{
    const auto call = reinterpret_cast<std::uintptr_t>(returnAddress) - 1;
    Dl_info info{};
    if (!dladdr(reinterpret_cast<const void*>(call), &info) || !info.dli_fname) return {"", "", call};
    Frame frame{std::filesystem::path(info.dli_fname).filename().string(), "", call - reinterpret_cast<std::uintptr_t>(info.dli_fbase)};
    if (!info.dli_sname) return frame;
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> name(abi::__cxa_demangle(info.dli_sname, nullptr, nullptr, &status), std::free);
    frame.function = status == 0 && name ? name.get() : info.dli_sname;
    return frame;
}

// Says nothing of the program: how a place was found, and what MPI does within a call.
bool isInner(const Frame& frame)
{
    for (const char* const name : {"CallPlace::", "CheckedParts::", "Communicator::", "tellPlace"})
    {
        if (frame.function.find(name) != std::string::npos) return true;
    }
    for (const char* const name : {"libmpi.", "libopen-pal.", "mca_", "libc.so"})
    {
        if (frame.library.starts_with(name) && !frame.function.starts_with("MPI_")) return true;
    }
    return false;
}

}

CallPlace CallPlace::here()
{
    CallPlace place;
    place.size_ = backtrace(place.frames_.data(), deepest);
    return place;
}

std::uint64_t CallPlace::hash() const
{
    std::uint64_t all = 0;
    for (int k = 0; k < size_; ++k)
    {
        Dl_info info{};
        if (!dladdr(frames_[k], &info) || !info.dli_fbase) continue;
        // Of a call in a function compilers make several, by what they know in each: the function counts.
        const std::uintptr_t function = info.dli_saddr ? reinterpret_cast<std::uintptr_t>(info.dli_saddr) - reinterpret_cast<std::uintptr_t>(info.dli_fbase) : 0;
        all = all * 0x9e3779b97f4a7c15u + function;
    }
    return all;
}

std::string CallPlace::text(int most) const
{
    std::ostringstream text;
    int shown = 0;
    for (int k = 0; k < size_ && shown < most; ++k)
    {
        const Frame frame = frameOf(frames_[k]);
        if (isInner(frame)) continue;
        text << "\n        " << (frame.function.empty() ? "" : frame.function + ", ") << frame.library << " 0x" << std::hex << frame.offset << std::dec;
        ++shown;
    }
    return text.str();
}

}
