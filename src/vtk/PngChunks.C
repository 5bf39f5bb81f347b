// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/PngChunks.H"

#include <boost/crc.hpp>

#include <cstdint>
#include <string_view>

namespace shizuku
{

namespace
{

// Four bytes, the highest first.
std::uint32_t numberAt(const std::string& content, std::size_t at)
{
    std::uint32_t number = 0;
    for (int byte = 0; byte < 4; ++byte) number = number << 8 | std::uint8_t(content[at + byte]);
    return number;
}

}

bool isWholePng(const std::string& content)
{
    constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
    constexpr std::size_t frame = 12;               // length, name and checksum
    if (!content.starts_with(signature)) return false;
    for (std::size_t at = signature.size(); at + frame <= content.size();)
    {
        const std::size_t length = numberAt(content, at);
        if (at + frame + length > content.size()) return false;
        const std::string_view named(content.data() + at + 4, 4 + length);
        boost::crc_32_type checksum;
        checksum.process_bytes(named.data(), named.size());
        if (checksum.checksum() != numberAt(content, at + 8 + length)) return false;
        if (named.starts_with("IEND")) return true;
        at += frame + length;
    }
    return false;
}

}
