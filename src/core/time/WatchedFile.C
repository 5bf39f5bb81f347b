// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/WatchedFile.H"

#include <sys/stat.h>

namespace shizuku
{

WatchedFile::WatchedFile(std::filesystem::path file) : path_(std::move(file)), last_(stamp()) {}

bool WatchedFile::changed()
{
    const Stamp now = stamp();
    if (now == Stamp{} || now == last_) return false;
    last_ = now;
    return true;
}

WatchedFile::Stamp WatchedFile::stamp() const
{
    struct stat status;
    if (::stat(path_.c_str(), &status) != 0 || status.st_size == 0) return {};
    return {long(status.st_mtim.tv_sec), long(status.st_mtim.tv_nsec), long(status.st_size), long(status.st_ino)};
}

}
