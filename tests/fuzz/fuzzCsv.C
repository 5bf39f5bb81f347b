// SPDX-License-Identifier: GPL-3.0-or-later
// Tables.

#include "core/fieldFile/CsvTable.H"
#include "fuzz/FuzzInput.H"

using namespace shizuku;
using namespace shizuku::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return readOrRefuse([&]
    {
        const CsvTable table = CsvTable::read(fileOf(data, size, ".csv"));
        for (const std::string& column : table.columns()) table.numbers(column);
    });
}
