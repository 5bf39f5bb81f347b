// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PatchedSurface.H"

#include "core/messages/Error.H"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace shizuku
{

namespace
{

std::string asWord(std::string name)
{
    for (char& c : name)
    {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = byte >= 0x80 || std::isalnum(byte) || std::strchr("_-.+:", c);
        if (!plain) c = '_';
    }
    return name;
}

}

int PatchedSurface::patchIndex(const PatchName& name)
{
    for (std::size_t p = given_.size(); p < patches.size(); ++p) given_.push_back(patches[p]);
    // A name of one word is also that of the patch whose longer name begins with it.
    const auto known = std::find_if(given_.begin(), given_.end(), [&](const std::string& given)
    {
        return given == name.given || given.starts_with(name.given + ' ');
    });
    if (known != given_.end()) return static_cast<int>(known - given_.begin());

    const auto taken = [&](const std::string& word) { return std::find(patches.begin(), patches.end(), word) != patches.end(); };
    std::string word = asWord(name.word);
    if (taken(word))
    {
        const std::string whole = asWord(name.given);
        const std::string first = given_[std::find(patches.begin(), patches.end(), word) - patches.begin()];
        word = whole;
        for (int number = 2; taken(word); ++number) word = whole + "_" + std::to_string(number);
        warning("The patches '" + first + "' and '" + name.given + "' would have the same name; the second one is called " + word);
    }
    patches.push_back(word);
    given_.push_back(name.given);
    return static_cast<int>(patches.size()) - 1;
}

}
