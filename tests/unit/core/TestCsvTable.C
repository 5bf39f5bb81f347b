// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/CsvFile.H"
#include "core/fieldFile/CsvTable.H"
#include "support/ScratchFolder.H"

#include <cmath>

using namespace shizuku;
using namespace shizuku::test;

TEST(CsvTable, ReadsWhatCsvFileWrites)
{
    const ScratchFolder folder;
    CsvFile file(folder.path()/"a.csv", {{"time", "s"}, {"state", ""}, {"angle", "deg"}});
    file.addRow({0.5, std::string("a, \"b\""), -61.25});
    file.addRow({1e-3, std::string("film"), std::nan("")});
    file.write();

    const CsvTable table = CsvTable::read(file.file());
    EXPECT_EQ(table.rows(), 2u);
    EXPECT_TRUE(table.has("time"));
    EXPECT_FALSE(table.has("time [s]"));
    EXPECT_EQ(table.number(0, "angle"), -61.25);
    EXPECT_EQ(table.text(0, "state"), "a, \"b\"");
    EXPECT_TRUE(std::isnan(table.number(1, "angle")));
    EXPECT_EQ(table.numbers("time"), (std::vector<double>{0.5, 1e-3}));
}

TEST(CsvTable, JoinsTheTablesOfAnInterruptedRun)
{
    const ScratchFolder folder;
    CsvTable first = CsvTable::read(folder.write("a.csv", "time [s],x\n1,10\n2,20\n3,30\n"));
    first.continueWith(CsvTable::read(folder.write("b.csv", "time [s],x\n3,31\n4,41\n")), "time");
    EXPECT_EQ(first.numbers("x"), (std::vector<double>{10, 20, 31, 41}));
    const CsvTable other = CsvTable::read(folder.write("c.csv", "time [s],y\n5,50\n"));
    EXPECT_TRUE(holds(messageOf([&] { first.continueWith(other, "time"); }), {"c.csv", "not those of", "a.csv"}));
}

TEST(CsvTable, SaysWhatIsWrong)
{
    const ScratchFolder folder;
    const auto error = [&](const std::string& text) { return messageOf([&] { CsvTable::read(folder.write("a.csv", text)); }); };
    EXPECT_TRUE(holds(error(""), {"a.csv", "missing or empty"}));
    EXPECT_TRUE(holds(error("a,b\n1,2\n3\n"), {"a.csv", "line 3", "1 cells", "2, one for each column"}));
    const CsvTable table = CsvTable::read(folder.write("a.csv", "time [s],state\n1,film\n"));
    EXPECT_TRUE(holds(messageOf([&] { table.number(0, "tine"); }), {"no column 'tine'", "'time'"}));
    EXPECT_TRUE(holds(messageOf([&] { table.number(0, "state"); }), {"a.csv", "'film' of state is no number"}));
}
