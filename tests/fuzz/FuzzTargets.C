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

#include <unistd.h>

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
        {"study", [](const std::string& text) { runsOf(Study::read(InputFile(text, ""))); }}
    };
    return targets;
}

void readOrRefuse(const FuzzTarget& target, const std::string& text)
{
    try { target.read(text); }
    catch (const FatalError&) {}
}

}
