// SPDX-License-Identifier: GPL-3.0-or-later
// OFF files.

#include "sampling/SurfaceFile.H"
#include "fuzz/FuzzInput.H"

using namespace shizuku;
using namespace shizuku::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return readOrRefuse([&] { readSurface(fileOf(data, size, ".off"), "wall"); });
}
