// SPDX-License-Identifier: GPL-3.0-or-later
// What libFuzzer calls. SHIZUKU_FUZZ_TARGET of the environment names the reader.

#include "fuzz/FuzzTargets.H"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>

using namespace shizuku::test;

namespace
{

const FuzzTarget& chosenTarget()
{
    const char* const name = std::getenv("SHIZUKU_FUZZ_TARGET");
    for (const FuzzTarget& target : fuzzTargets())
    {
        if (name && target.name == name) return target;
    }
    std::cerr << "SHIZUKU_FUZZ_TARGET names no reader; valid:";
    for (const FuzzTarget& target : fuzzTargets()) std::cerr << " " << target.name;
    std::cerr << std::endl;
    std::exit(1);
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const FuzzTarget& target = chosenTarget();
    readOrRefuse(target, {reinterpret_cast<const char*>(data), size});
    return 0;
}
