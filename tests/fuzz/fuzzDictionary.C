// SPDX-License-Identifier: GPL-3.0-or-later
// The grammar of dictionaries and their expansion: macros, directives, patterns.

#include "core/dictionary/Dictionary.H"
#include "fuzz/FuzzInput.H"

using namespace shizuku;
using namespace shizuku::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return readOrRefuse([&] { Dictionary::parse(textOf(data, size)); });
}
