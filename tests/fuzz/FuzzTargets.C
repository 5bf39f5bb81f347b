// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/FuzzTargets.H"

#include "core/dictionary/CalcExpression.H"
#include "core/dictionary/Dictionary.H"
#include "core/fieldFile/CsvTable.H"
#include "core/fieldFile/FieldFile.H"
#include "core/messages/Error.H"
#include "liveView/ViewCommand.H"
#include "meshes/ObjFile.H"
#include "meshes/PlyFile.H"
#include "meshes/StlFile.H"
#include "sampling/SurfaceFile.H"
#include "study/Study.H"
#include "vtk/PngFile.H"

#include <boost/crc.hpp>
#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>

namespace shizuku::test
{

namespace
{

// A file in memory, where there is a folder for that, for one input after the other: a new file for each takes longer than most readers. Gone with the program.
class InputFile
{
public:
    explicit InputFile(const std::string& extension) : path_(folder()/(name() + extension)), file_(::open(path_.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600))
    {
        if (file_ < 0) throw std::runtime_error("Cannot write " + path_.string());
    }
    ~InputFile()
    {
        ::close(file_);
        std::filesystem::remove(path_);
    }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& with(const std::string& text) const
    {
        if (::pwrite(file_, text.data(), text.size(), 0) != ssize_t(text.size()) || ::ftruncate(file_, off_t(text.size())) != 0)
        {
            throw std::runtime_error("Cannot write " + path_.string());
        }
        return path_;
    }

private:
    static std::filesystem::path folder()
    {
        const std::filesystem::path shared = "/dev/shm";
        return std::filesystem::is_directory(shared) ? shared : std::filesystem::temp_directory_path();
    }
    static std::string name() { return "shizukuFuzz." + std::to_string(::getpid()); }

    const std::filesystem::path path_;
    const int file_;
};

// The input as a file of that name.
const std::filesystem::path& fileOf(const std::string& text, const std::string& extension)
{
    static std::map<std::string, InputFile> files;
    return files.try_emplace(extension, extension).first->second.with(text);
}

void readCalc(const std::string& text)
{
    const auto macro = [](const std::string& name) { return double(name.size()); };
    CalcExpression(text, {}, macro, {"x"})({0.5});
}

void readTable(const std::string& text)
{
    const CsvTable table = CsvTable::read(fileOf(text, ".csv"));
    for (const std::string& column : table.columns()) table.numbers(column);
}

// The checksums of PNG's chunks made right: mutations get no farther than to them otherwise.
std::string withChecksums(std::string png)
{
    constexpr std::size_t signature = 8, frame = 12;        // length, name and checksum of a chunk
    const auto byte = [&](std::size_t at) { return std::uint8_t(png[at]); };
    for (std::size_t at = signature; at + frame <= png.size();)
    {
        const std::size_t length = std::size_t(byte(at)) << 24 | std::size_t(byte(at + 1)) << 16 | std::size_t(byte(at + 2)) << 8 | byte(at + 3);
        if (length > png.size() - at - frame) break;
        boost::crc_32_type checksum;
        checksum.process_bytes(png.data() + at + 4, 4 + length);
        for (int k = 0; k < 4; ++k) png[at + 8 + length + std::size_t(k)] = char(checksum.checksum() >> (24 - 8*k));
        at += frame + length;
    }
    return png;
}

void readPng(const std::string& text)
{
    try { greyOfPng(withChecksums(text)); }
    catch (const DamagedImage& damage) { throw FatalError(damage.what()); }
}

}

const std::vector<FuzzTarget>& fuzzTargets()
{
    static const std::vector<FuzzTarget> targets
    {
        {"dictionary", [](const std::string& text) { Dictionary::parse(text); }},
        {"calc", readCalc},
        {"field", [](const std::string& text) { readField(fileOf(text, "")); }},
        {"stl", [](const std::string& text) { readStl(fileOf(text, ".stl"), "wall"); }},
        {"obj", [](const std::string& text) { readObj(fileOf(text, ".obj"), "wall"); }},
        {"ply", [](const std::string& text) { readPly(fileOf(text, ".ply")); }},
        {"off", [](const std::string& text) { readSurface(fileOf(text, ".off"), "wall"); }},
        {"csv", readTable},
        {"study", [](const std::string& text) { runsOf(Study::read(fileOf(text, ""))); }},
        {"png", readPng},
        {"view", [](const std::string& text) { ViewCommand::parse(text); }}
    };
    return targets;
}

void readOrRefuse(const FuzzTarget& target, const std::string& text)
{
    try { target.read(text); }
    catch (const FatalError&) {}
}

}
