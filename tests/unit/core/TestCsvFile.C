// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/CsvFile.H"
#include "support/ScratchFolder.H"

#include <limits>
#include <stdexcept>

using namespace shizuku;
using namespace shizuku::test;

TEST(CsvFile, WritesUnitsInTheHeaderAndNineDigits)
{
    const ScratchFolder folder;
    CsvFile table(folder.path() / "postProcessing/angle/0/angle.csv", {{"time", "s"}, {"angle", "deg"}, {"state", ""}});
    table.addRow({0.05, 61.25, "sessile"});
    table.addRow({1.0 / 3, std::numeric_limits<double>::quiet_NaN(), "off, \"free\""});
    table.write();
    EXPECT_EQ
    (
        folder.read("postProcessing/angle/0/angle.csv"),
        "time [s],angle [deg],state\n"
        "0.05,61.25,sessile\n"
        "0.333333333,nan,\"off, \"\"free\"\"\"\n"
    );
}

TEST(CsvFile, MayBeWrittenAfterEachRow)
{
    const ScratchFolder folder;
    CsvFile table(folder.path() / "volume.csv", {{"volume", "m^3"}});
    for (int i = 1; i <= 3; ++i)
    {
        table.addRow({i * 1e-9});
        table.write();
    }
    EXPECT_EQ(folder.read("volume.csv"), "volume [m^3]\n1e-09\n2e-09\n3e-09\n");
    EXPECT_EQ(table.rows(), 3u);
}

TEST(CsvFile, TakesRowsOfAnother)
{
    const ScratchFolder folder;
    CsvFile table(folder.path() / "volume.csv", {{"volume", "m^3"}}), other(folder.path() / "other.csv", {{"volume", "m^3"}});
    table.addRow({1.0});
    other.addRow({2.0});
    table.addRows(other.takeRows());
    table.addRows(other.takeRows());
    table.write();
    other.write();
    EXPECT_EQ(folder.read("volume.csv"), "volume [m^3]\n1\n2\n");
    EXPECT_EQ(folder.read("other.csv"), "volume [m^3]\n");
}

// What was written is not kept: a long run's tables take no memory. A table that is there from another run is replaced.
TEST(CsvFile, AddsToWhatIsOnTheDisk)
{
    const ScratchFolder folder;
    folder.write("volume.csv", "of another run\n");
    CsvFile table(folder.path() / "volume.csv", {{"volume", "m^3"}});
    table.addRow({1.0});
    const WriteJob first = table.writing();
    table.addRow({2.0});
    const WriteJob second = table.writing();
    first();
    EXPECT_EQ(folder.read("volume.csv"), "volume [m^3]\n1\n");
    second();
    table.write();
    EXPECT_EQ(folder.read("volume.csv"), "volume [m^3]\n1\n2\n");

    std::filesystem::remove(folder.path() / "volume.csv");
    table.addRow({3.0});
    table.write();
    EXPECT_EQ(folder.read("volume.csv"), "volume [m^3]\n3\n");
    EXPECT_EQ(table.rows(), 3u);
}

TEST(CsvFile, RefusesARowOfAnotherLength)
{
    CsvFile table("unused.csv", {{"time", "s"}, {"angle", "deg"}});
    EXPECT_THROW(table.addRow({1.0}), std::logic_error);
    EXPECT_EQ(table.rows(), 0u);
}
