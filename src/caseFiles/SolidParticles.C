// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/SolidParticles.H"

#include "caseFiles/VectorField.H"
#include "core/dictionary/Dictionary.H"
#include "core/fieldFile/AtomicFile.H"
#include "core/fieldFile/FoamFileHeader.H"

#include <algorithm>

namespace shizuku
{

namespace
{

std::filesystem::path folderOf(const std::filesystem::path& casePath)
{
    return casePath/"constant"/"solid";
}

void writePatches(std::ostream& stream, const std::vector<std::string>& patches)
{
    stream << "patches\n(\n";
    for (const std::string& patch : patches) stream << "    " << patch << '\n';
    stream << ");\n";
}

}

void SolidParticles::append(const SolidParticles& other)
{
    std::vector<int> label;
    for (const std::string& name : other.patches)
    {
        const auto found = std::find(patches.begin(), patches.end(), name);
        label.push_back(static_cast<int>(found - patches.begin()));
        if (found == patches.end()) patches.push_back(name);
    }
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
    normals.insert(normals.end(), other.normals.begin(), other.normals.end());
    for (int p : other.patch) patch.push_back(label[p]);
    marks.insert(marks.end(), other.marks.begin(), other.marks.end());
}

void writeSolidParticles
(
    const std::filesystem::path& casePath, const SolidParticles& particles, const WriteFormat& format
)
{
    FieldData patch{"patch", FieldType::label, dimensions::none, false, {}};
    patch.values.assign(particles.patch.begin(), particles.patch.end());
    writeFolderAtomically(folderOf(casePath), [&](const std::filesystem::path& folder)
    {
        writeField(folder/"positions", toField("positions", dimensions::length, particles.positions), format.ofPlaces());
        writeField(folder/"normals", toField("normals", dimensions::none, particles.normals), format);
        writeField(folder/"patch", patch, format);
        const auto writeDictionary = [&](const std::string& name, const auto& writeEntries)
        {
            writeAtomically(folder/name, [&](std::ostream& stream)
            {
                writeFoamFileHeader(stream, folder/name, "dictionary");
                writeEntries(stream);
            });
        };
        writeDictionary("patches", [&](std::ostream& stream) { writePatches(stream, particles.patches); });
        if (particles.marks.empty()) return;
        writeDictionary("surfaces", [&](std::ostream& stream) { writeMarks(stream, particles.marks); });
    });
}

bool useSolidParticles(const std::filesystem::path& casePath)
{
    const auto file = casePath/"constant/walls";
    if (!std::filesystem::exists(file)) return true;
    const Dictionary walls = Dictionary::read(file);
    const std::vector<std::string> names = walls.dictKeys();
    return std::any_of(names.begin(), names.end(), [&](const std::string& name)
    {
        return walls.subDict(name).lookupOr<std::string>("type", "") == "particles";
    });
}

bool haveSolidParticles(const std::filesystem::path& casePath)
{
    return std::filesystem::exists(folderOf(casePath)) && useSolidParticles(casePath);
}

std::vector<std::string> readSolidPatches(const std::filesystem::path& casePath)
{
    return Dictionary::read(folderOf(casePath)/"patches").lookup<std::vector<std::string>>("patches");
}

SolidParticles readSolidParticles(const std::filesystem::path& casePath)
{
    const std::filesystem::path folder = folderOf(casePath);
    const FieldData positions = readField(folder/"positions", FieldType::vector, dimensions::length);
    const std::size_t count = positions.elements();
    const FieldData normals = readField(folder/"normals", FieldType::vector, dimensions::none, long(count));
    const FieldData patch = readField(folder/"patch", FieldType::label, dimensions::none, long(count));

    SolidParticles particles;
    particles.positions = toVectors(positions, count);
    particles.normals = toVectors(normals, count);
    particles.patches = readSolidPatches(casePath);
    for (std::size_t i = 0; i < count; ++i)
    {
        const double label = patch(i);
        if (label < 0 || label >= double(particles.patches.size()))
        {
            throw FatalInputError
            (
                {(folder/"patch").string(), 0},
                "Solid particle " + std::to_string(i) + " has the patch label " + std::to_string(long(label)),
                "labels from 0 to " + std::to_string(long(particles.patches.size()) - 1) + ", see constant/solid/patches"
            );
        }
        particles.patch.push_back(static_cast<int>(label));
    }
    return particles;
}

}
