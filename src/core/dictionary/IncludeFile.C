// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/IncludeFile.H"
#include "core/paths/Existence.H"

#include <cstdlib>

namespace shizuku
{

namespace fs = std::filesystem;

namespace
{

fs::path environmentPath(const char* variable)
{
    const char* value = std::getenv(variable);
    return value ? fs::path(value) : fs::path();
}

// The folder with bin/<program> and etc in it, or that with build/bin/<program>; links to the program are followed. Empty where the system does not
// tell.
fs::path installation()
{
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error), folder = program.parent_path().parent_path();
    return fs::is_directory(folder/"etc", error) ? folder : folder.parent_path();
}

}

fs::path caseFolder(const fs::path& file)
{
    for (fs::path folder = fs::absolute(file).lexically_normal().parent_path(); ; folder = folder.parent_path())
    {
        if (isThere(folder/"system"/"controlDict")) return folder;
        if (folder == folder.root_path()) return fs::current_path();
    }
}

std::vector<fs::path> etcFolders()
{
    std::vector<fs::path> folders
    {
        environmentPath("HOME")/".shizuku", environmentPath("SHIZUKU_DIR")/"etc", installation()/"etc"
    };
    std::erase_if(folders, [](const fs::path& folder) { return !folder.is_absolute(); });   // what is not set
    return folders;
}

std::optional<fs::path> findEtcFile(const std::string& name)
{
    for (const fs::path& folder : etcFolders())
    {
        if (isFile(folder/name)) return folder/name;
    }
    return {};
}

fs::path includePath(const std::string& name, const fs::path& includingFile)
{
    const auto behind = [&](const std::string& prefix) { return name.substr(prefix.size()); };
    if (name.starts_with("~/")) return environmentPath("HOME")/behind("~/");
    if (name.starts_with("<case>/")) return caseFolder(includingFile)/behind("<case>/");
    if (name.starts_with("<system>/")) return caseFolder(includingFile)/"system"/behind("<system>/");
    if (name.starts_with("<constant>/")) return caseFolder(includingFile)/"constant"/behind("<constant>/");
    if (name.starts_with("<etc>/")) return findEtcFile(behind("<etc>/")).value_or(behind("<etc>/"));
    return (includingFile.parent_path()/name).lexically_normal();
}

}
