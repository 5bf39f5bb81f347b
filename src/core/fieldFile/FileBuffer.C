// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/FileBuffer.H"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace shizuku
{

FileBuffer::FileBuffer(const std::filesystem::path& file)
    : descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)), buffer_(1 << 16)
{
    if (descriptor_ < 0) keepReason();
    setp(buffer_.data(), buffer_.data() + buffer_.size());
}

FileBuffer::FileBuffer(const std::filesystem::path& file, std::uint64_t begin)
    : descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666)), buffer_(1 << 16)
{
    if (descriptor_ < 0 || ::lseek(descriptor_, off_t(begin), SEEK_SET) < 0) keepReason();
    setp(buffer_.data(), buffer_.data() + buffer_.size());
}

FileBuffer::~FileBuffer()
{
    if (descriptor_ >= 0) ::close(descriptor_);
}

bool FileBuffer::close()
{
    flushBuffer();
    if (descriptor_ >= 0)
    {
        // Devices and pipes cannot be synced and say EINVAL.
        if (::fsync(descriptor_) != 0 && errno != EINVAL) keepReason();
        if (::close(descriptor_) != 0) keepReason();
        descriptor_ = -1;
    }
    return failure_.empty();
}

FileBuffer::int_type FileBuffer::overflow(int_type character)
{
    if (!flushBuffer()) return traits_type::eof();
    if (!traits_type::eq_int_type(character, traits_type::eof()))
    {
        *pptr() = traits_type::to_char_type(character);
        pbump(1);
    }
    return traits_type::not_eof(character);
}

std::streamsize FileBuffer::xsputn(const char* data, std::streamsize size)
{
    if (size <= epptr() - pptr())
    {
        std::memcpy(pptr(), data, size);
        pbump(static_cast<int>(size));
        return size;
    }
    return flushBuffer() && writeAll(data, size) ? size : 0;
}

int FileBuffer::sync()
{
    return flushBuffer() ? 0 : -1;
}

bool FileBuffer::flushBuffer()
{
    const std::size_t size = pptr() - pbase();
    setp(buffer_.data(), buffer_.data() + buffer_.size());
    return writeAll(buffer_.data(), size);
}

bool FileBuffer::writeAll(const char* data, std::size_t size)
{
    if (!failure_.empty()) return false;
    while (size > 0)
    {
        const ssize_t written = ::write(descriptor_, data, size);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0)
        {
            keepReason();
            return false;
        }
        data += written;
        size -= written;
    }
    return true;
}

void FileBuffer::keepReason()
{
    if (failure_.empty()) failure_ = std::strerror(errno);
}

}
