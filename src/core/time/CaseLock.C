// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/time/CaseLock.H"

#include "core/messages/Error.H"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace shizuku
{

CaseLock::CaseLock(const std::filesystem::path& casePath) : folder_(::open(casePath.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
{
    if (folder_ < 0 || ::flock(folder_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
    ::close(folder_);
    throw FatalError
    (
        "Another solver runs in " + casePath.string() + ": both would write the same times.\n    Wait for it, or run in a copy of the case."
    );
}

CaseLock::~CaseLock()
{
    if (folder_ >= 0) ::close(folder_);
}

}
