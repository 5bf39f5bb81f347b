// SPDX-License-Identifier: GPL-3.0-or-later
// STL files, ascii and binary.

#include "meshes/StlFile.H"
#include "fuzz/FuzzInput.H"

using namespace shizuku;
using namespace shizuku::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return readOrRefuse([&] { readStl(fileOf(data, size, ".stl"), "wall"); });
}
