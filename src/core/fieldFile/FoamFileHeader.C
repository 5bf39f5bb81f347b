// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/FoamFileHeader.H"

#include "core/fieldFile/AtomicFile.H"

namespace shizuku
{

namespace
{

// "0.05/liquid" of <case>/0.05/liquid/U, "constant" of <case>/constant/g.
std::string locationOf(const std::filesystem::path& file)
{
    const auto folder = file.parent_path();
    const std::string inner = finalName(folder.filename().string());
    const std::string outer = finalName(folder.parent_path().filename().string());
    const bool nested = !outer.empty() && inner != "constant" && inner != "system";
    return nested ? outer + "/" + inner : inner;
}

}

void writeFoamFileHeader
(
    std::ostream& stream, const std::filesystem::path& file, const std::string& foamClass, const std::string& arch,
    const std::string& meta
)
{
    stream << "FoamFile\n{\n    version     2.0;\n    format      " << (arch.empty() ? "ascii" : "binary") << ";\n";
    if (!arch.empty()) stream << "    arch        \"" << arch << "\";\n";
    stream
        << "    class       " << foamClass << ";\n"
        << "    location    \"" << locationOf(file) << "\";\n"
        << "    object      " << finalName(file.filename().string()) << ";\n";
    if (!meta.empty()) stream << "    meta        { " << meta << " }\n";
    stream << "}\n\n";
}

}
