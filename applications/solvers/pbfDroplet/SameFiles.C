// SPDX-License-Identifier: GPL-3.0-or-later
#include "SameFiles.H"

#include "core/messages/Error.H"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <thread>

namespace shizuku
{

namespace
{

// Of what is in them; a file that is not there has no contents.
std::size_t digest(const std::vector<std::filesystem::path>& files)
{
    std::string all;
    for (const auto& file : files)
    {
        std::ifstream stream(file, std::ios::binary);
        all.append(std::istreambuf_iterator<char>(stream), {});
        all += '\n';
    }
    return std::hash<std::string>()(all);
}

}

void awaitSameFiles(const Communicator& parts, const std::vector<std::filesystem::path>& files)
{
    if (parts.parts() == 1) return;
    constexpr int attempts = 300;
    for (int attempt = 0; attempt < attempts; ++attempt)
    {
        const std::vector<std::size_t> all = parts.gather(digest(files));
        if (std::all_of(all.begin(), all.end(), [&](std::size_t each) { return each == all.front(); })) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    throw FatalError("The parts of the run do not see the same contents of " + files.front().string() + " and what is read with it");
}

bool readIfModified(Time& time, const Communicator& parts)
{
    if (!parts.any(time.modified())) return false;
    awaitSameFiles(parts, {time.casePath() / "system/controlDict"});
    if (parts.parts() > 1) time.modified();     // who sees the same file later
    return time.readAnew();
}

}
