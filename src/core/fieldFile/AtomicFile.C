// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/AtomicFile.H"

#include "core/fieldFile/FileBuffer.H"
#include "core/messages/Error.H"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

const std::string suffix = ".partial";

[[noreturn]] void fail(const fs::path& path, const std::string& reason)
{
    throw FatalError("Cannot write " + path.string() + ": " + reason);
}

void makeFolder(const fs::path& folder, const fs::path& wanted)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) fail(wanted, error.message() + " (folder " + folder.string() + ")");
}

// The folders that lead to a file. Those that had to be made go again, unless the file came to be.
class LeadingFolders
{
public:
    LeadingFolders(const fs::path& folder, const fs::path& wanted)
    {
        for (fs::path part = folder; !part.empty() && !fs::exists(part); part = part.parent_path()) made_.push_back(part);
        makeFolder(folder, wanted);
    }
    ~LeadingFolders()
    {
        std::error_code notEmpty;
        for (const fs::path& folder : made_) fs::remove(folder, notEmpty);
    }
    LeadingFolders(const LeadingFolders&) = delete;
    LeadingFolders& operator=(const LeadingFolders&) = delete;

private:
    std::vector<fs::path> made_;        // the innermost one first
};

fs::path parentOf(const fs::path& path)
{
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Makes a rename last through a power failure. File systems that cannot do it are left alone.
void syncFolder(const fs::path& folder)
{
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;
    ::fsync(descriptor);
    ::close(descriptor);
}

// Removes the temporary file or folder unless it became the result.
class Removal
{
public:
    explicit Removal(fs::path path) : path_(std::move(path)) {}
    ~Removal()
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    Removal(const Removal&) = delete;
    Removal& operator=(const Removal&) = delete;

private:
    fs::path path_;
};

// Puts the new folder in the old one's place; the old one then lies under the new one's former name.
void exchangeFolders(const fs::path& fresh, const fs::path& old)
{
    if (::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, old.c_str(), RENAME_EXCHANGE) == 0) return;

    // A file system without the exchange: two renames, by way of a name that no reader takes for a result.
    const fs::path aside = partialPath(parentOf(old) / (old.filename().string() + ".old"));
    std::error_code error;
    fs::remove_all(aside, error);
    fs::rename(old, aside, error);
    if (!error) fs::rename(fresh, old, error);
    if (error) fail(old, error.message());
    fs::remove_all(aside, error);
}

}

fs::path partialPath(const fs::path& path)
{
    std::string name = ".";
    name.append(path.filename().string()).append(suffix);
    return path.parent_path() / name;
}

bool isPartialName(const std::string& name)
{
    return name.size() > suffix.size() + 1 && name.front() == '.' && name.ends_with(suffix);
}

std::string finalName(const std::string& name)
{
    return isPartialName(name) ? name.substr(1, name.size() - suffix.size() - 1) : name;
}

void writeAtomically(const fs::path& file, const std::function<void(std::ostream&)>& write)
{
    const LeadingFolders folders(parentOf(file), file);
    if (fs::exists(file) && !fs::is_regular_file(file)) fail(file, "it is there and is not a regular file");

    const fs::path temporary = partialPath(file);
    FileBuffer buffer(temporary);
    if (!buffer.failure().empty()) fail(file, buffer.failure());
    const Removal removal(temporary);

    std::ostream stream(&buffer);
    write(stream);
    if (!buffer.close()) fail(file, buffer.failure());
    if (!stream) fail(file, "the output stream failed");
    if (std::rename(temporary.c_str(), file.c_str()) != 0) fail(file, std::strerror(errno));
    syncFolder(parentOf(file));
}

void writeFolderAtomically(const fs::path& folder, const std::function<void(const fs::path&)>& write)
{
    const fs::path temporary = partialPath(folder);
    const Removal removal(temporary);
    makePartialFolder(folder);
    write(temporary);
    putFolderInPlace(folder);
}

void makePartialFolder(const fs::path& folder)
{
    if (fs::exists(folder) && !fs::is_directory(folder)) fail(folder, "it is there and is not a folder");
    const fs::path temporary = partialPath(folder);
    std::error_code error;
    fs::remove_all(temporary, error);
    makeFolder(temporary, folder);
}

void putFolderInPlace(const fs::path& folder)
{
    const fs::path temporary = partialPath(folder);
    syncFolder(temporary);
    const Removal removal(temporary);
    if (fs::exists(folder)) exchangeFolders(temporary, folder);
    else
    {
        std::error_code error;
        fs::rename(temporary, folder, error);
        if (error) fail(folder, error.message());
    }
    syncFolder(parentOf(folder));
}

void removeFolderAtomically(const fs::path& folder)
{
    const fs::path aside = partialPath(folder);
    std::error_code error;
    fs::remove_all(aside, error);
    fs::rename(folder, aside, error);
    if (!error) fs::remove_all(aside, error);
    if (error && error != std::errc::no_such_file_or_directory)
    {
        throw FatalError("Cannot remove " + folder.string() + ": " + error.message());
    }
}

}
