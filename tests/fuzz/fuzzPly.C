// SPDX-License-Identifier: GPL-3.0-or-later
// PLY files, ascii and binary.

#include "meshes/PlyFile.H"
#include "fuzz/FuzzInput.H"

using namespace shizuku;
using namespace shizuku::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return readOrRefuse([&] { readPly(fileOf(data, size, ".ply")); });
}
