// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/MappedFile.H"

#include "core/messages/Error.H"
#include "core/paths/Existence.H"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace shizuku
{

MappedFile::MappedFile(const std::filesystem::path& file)
{
    const SourceLocation where{file.string(), 0};
    if (!isThere(file)) throw FatalInputError(where, "The field file is missing");
    if (!isFile(file)) throw FatalInputError(where, "This is not a file", "a field file");
    const std::size_t size = std::filesystem::file_size(file);
    if (size == 0) return;

    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    void* const data = descriptor < 0 ? MAP_FAILED : ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    const int reason = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (data == MAP_FAILED)
    {
        throw FatalInputError(where, std::string("The field file cannot be read: ") + std::strerror(reason));
    }
    ::madvise(data, size, MADV_SEQUENTIAL);
    text_ = {static_cast<const char*>(data), size};
}

MappedFile::~MappedFile()
{
    if (!text_.empty()) ::munmap(const_cast<char*>(text_.data()), text_.size());
}

}
