// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/FuzzTargets.H"

#include "core/dictionary/CalcExpression.H"
#include "core/dictionary/Dictionary.H"
#include "core/fieldFile/CsvTable.H"
#include "core/fieldFile/FieldFile.H"
#include "core/messages/Error.H"
#include "meshes/ObjFile.H"
#include "meshes/PlyFile.H"
#include "meshes/StlFile.H"
#include "sampling/SurfaceFile.H"
#include "study/Study.H"
#include "vtk/PngFile.H"

#include <boost/crc.hpp>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

namespace shizuku::test
{

namespace
{

// The input as a file, in memory where there is a folder for that; gone with this.
class InputFile
{
public:
    InputFile(const std::string& text, const std::string& extension) : path_(folder()/(name() + extension))
    {
        std::ofstream(path_, std::ios::binary) << text;
    }
    ~InputFile() { std::filesystem::remove(path_); }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    operator const std::filesystem::path&() const { return path_; }

private:
    static std::filesystem::path folder()
    {
        const std::filesystem::path shared = "/dev/shm";
        return std::filesystem::is_directory(shared) ? shared : std::filesystem::temp_directory_path();
    }
    static std::string name() { return "shizukuFuzz." + std::to_string(::getpid()); }

    const std::filesystem::path path_;
};

void readCalc(const std::string& text)
{
    const auto macro = [](const std::string& name) { return double(name.size()); };
    CalcExpression(text, {}, macro, {"x"})({0.5});
}

void readTable(const std::string& text)
{
    const CsvTable table = CsvTable::read(InputFile(text, ".csv"));
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
        {"field", [](const std::string& text) { readField(InputFile(text, "")); }},
        {"stl", [](const std::string& text) { readStl(InputFile(text, ".stl"), "wall"); }},
        {"obj", [](const std::string& text) { readObj(InputFile(text, ".obj"), "wall"); }},
        {"ply", [](const std::string& text) { readPly(InputFile(text, ".ply")); }},
        {"off", [](const std::string& text) { readSurface(InputFile(text, ".off"), "wall"); }},
        {"csv", readTable},
        {"study", [](const std::string& text) { runsOf(Study::read(InputFile(text, ""))); }},
        {"png", readPng}
    };
    return targets;
}

void readOrRefuse(const FuzzTarget& target, const std::string& text)
{
    try { target.read(text); }
    catch (const FatalError&) {}
}

}
