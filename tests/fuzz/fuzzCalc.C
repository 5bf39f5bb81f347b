// SPDX-License-Identifier: GPL-3.0-or-later
// The arithmetic of #calc.

#include "core/dictionary/CalcExpression.H"
#include "fuzz/FuzzInput.H"

using namespace shizuku;
using namespace shizuku::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto macro = [](const std::string& name) { return double(name.size()); };
    return readOrRefuse([&] { CalcExpression(textOf(data, size), {}, macro, {"x"})({0.5}); });
}
