// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/AtomicFile.H"
#include "support/ScratchFolder.H"

#include <stdexcept>

using namespace shizuku;
using namespace shizuku::test;
namespace fs = std::filesystem;

using Names = std::vector<std::string>;

TEST(AtomicFile, WritesMakesFoldersAndReplaces)
{
    const ScratchFolder folder;
    const fs::path file = folder.path() / "a/b/table";
    writeAtomically(file, [](std::ostream& stream) { stream << "old and long"; });
    writeAtomically(file, [](std::ostream& stream) { stream << "new" << ' ' << 7; });
    EXPECT_EQ(folder.read("a/b/table"), "new 7");
    EXPECT_EQ(folder.list("a/b"), Names{"table"});
}

TEST(AtomicFile, KeepsEveryByteOfSmallAndLargeWrites)
{
    const ScratchFolder folder;
    std::string expected;
    writeAtomically(folder.path() / "bytes", [&](std::ostream& stream)
    {
        // Pieces below, at and above the 64 KiB of the buffer.
        for (const std::size_t size : {1, 65535, 65536, 3, 200000, 65536, 1})
        {
            const std::string piece(size, static_cast<char>('a' + expected.size() % 26));
            expected += piece;
            stream << piece;
            stream.put('\n');
            expected += '\n';
        }
    });
    EXPECT_EQ(folder.read("bytes"), expected);
}

TEST(AtomicFile, AnErrorInBetweenLeavesTheOldFile)
{
    const ScratchFolder folder;
    const fs::path file = folder.write("table", "old");
    const auto interrupted = [](std::ostream& stream)
    {
        stream << "half";
        throw std::runtime_error("stop");
    };
    EXPECT_EQ(messageOf<std::runtime_error>([&] { writeAtomically(file, interrupted); }), "stop");
    EXPECT_EQ(folder.read("table"), "old");
    EXPECT_EQ(folder.list(), Names{"table"});
}

TEST(AtomicFile, AFullDiskIsAnErrorWithItsReason)
{
    // The temporary name leads to the device that is always full; it must survive.
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    for (const std::size_t size : {10, 1000000})        // fails at the last flush, and in the middle
    {
        const ScratchFolder folder;
        const fs::path file = folder.write("U", "old");
        fs::create_symlink("/dev/full", partialPath(file));
        const auto write = [&](std::ostream& stream) { stream << std::string(size, 'x') << "y"; };
        const std::string message = messageOf<FatalError>([&] { writeAtomically(file, write); });
        EXPECT_TRUE(holds(message, {"Cannot write " + file.string(), "No space left on device"}));
        EXPECT_EQ(folder.read("U"), "old");
        EXPECT_EQ(folder.list(), Names{"U"});
    }
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(AtomicFile, AnErrorLeavesNoFolderThatWasMadeForTheFile)
{
    const ScratchFolder folder;
    const auto fails = [](std::ostream&) { throw FatalError("halfway"); };
    folder.write("kept/file", "");
    EXPECT_THROW(writeAtomically(folder.path() / "a/b/file", fails), FatalError);
    EXPECT_THROW(writeAtomically(folder.path() / "kept/b/file", fails), FatalError);
    EXPECT_EQ(folder.list(), std::vector<std::string>{"kept"});
    EXPECT_EQ(folder.list("kept"), std::vector<std::string>{"file"});
}

TEST(AtomicFolder, AFileInItsPlaceIsKept)
{
    const ScratchFolder folder;
    folder.write("0.5", "a file");
    const auto call = [&] { writeFolderAtomically(folder.path() / "0.5", [](const fs::path&) {}); };
    EXPECT_TRUE(holds(messageOf<FatalError>(call), {"0.5", "not a folder"}));
    EXPECT_EQ(folder.read("0.5"), "a file");
}

TEST(AtomicFile, AnUnwritableFolderIsAnError)
{
    const ScratchFolder folder;
    folder.write("file", "");
    const auto write = [](std::ostream& stream) { stream << "x"; };
    const fs::path below = folder.path() / "file/U";        // a path below a file: unwritable for root, too
    EXPECT_TRUE
    (
        holds(messageOf<FatalError>([&] { writeAtomically(below, write); }), {below.string(), "Not a directory"})
    );

    fs::create_directories(folder.path() / "folder/inner");
    EXPECT_TRUE
    (
        holds(messageOf<FatalError>([&] { writeAtomically(folder.path() / "folder", write); }), {"not a regular file"})
    );
    EXPECT_TRUE
    (
        holds(messageOf<FatalError>([&] { writeAtomically("/dev/null", write); }), {"not a regular file"})
    );
    EXPECT_EQ(folder.list(), (Names{"file", "folder"}));
}

TEST(AtomicFolder, ReplacesAllThatWasThere)
{
    const ScratchFolder folder;
    folder.write("0.1/liquid/old", "old");
    folder.write(".0.1.partial/liquid/stale", "from a killed run");
    writeFolderAtomically(folder.path() / "0.1", [&](const fs::path& temporary)
    {
        EXPECT_EQ(temporary.filename(), ".0.1.partial");
        EXPECT_EQ(folder.read("0.1/liquid/old"), "old");       // there until the end
        writeAtomically(temporary / "liquid" / "U", [](std::ostream& stream) { stream << "new"; });
    });
    EXPECT_EQ(folder.list(), Names{"0.1"});
    EXPECT_EQ(folder.list("0.1/liquid"), Names{"U"});
    EXPECT_EQ(folder.read("0.1/liquid/U"), "new");
}

TEST(AtomicFolder, AnErrorInBetweenLeavesNothingOrTheOldOne)
{
    const ScratchFolder folder;
    folder.write("0.1/liquid/U", "old");
    const auto interrupted = [](const fs::path& temporary)
    {
        writeAtomically(temporary / "liquid/U", [](std::ostream& stream) { stream << "new"; });
        throw FatalError("diverged");
    };
    for (const char* name : {"0.1", "0.2"})
    {
        EXPECT_EQ(messageOf<FatalError>([&] { writeFolderAtomically(folder.path() / name, interrupted); }), "diverged");
    }
    EXPECT_EQ(folder.list(), Names{"0.1"});
    EXPECT_EQ(folder.read("0.1/liquid/U"), "old");
}

TEST(AtomicFolder, GoesAtOnce)
{
    const ScratchFolder folder;
    folder.write("0.1/liquid/U", "old");
    folder.write(".0.1.partial/liquid/U", "left by a killed run");
    removeFolderAtomically(folder.path() / "0.1");
    EXPECT_EQ(folder.list(), Names{});
    removeFolderAtomically(folder.path() / "0.1");      // not there: nothing to do
}

TEST(PartialNames, AreHiddenAndLeadBackToTheFinalName)
{
    EXPECT_EQ(partialPath("case/0.05"), fs::path("case/.0.05.partial"));
    EXPECT_TRUE(isPartialName(".0.05.partial"));
    EXPECT_EQ(finalName(".0.05.partial"), "0.05");
    for (const std::string name : {"0.05", ".partial", "0.05.partial", ".0.05"})
    {
        EXPECT_FALSE(isPartialName(name)) << name;
        EXPECT_EQ(finalName(name), name);
    }
}
