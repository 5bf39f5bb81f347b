// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/BoxSides.H"

#include <algorithm>
#include <sstream>
#include <vector>

namespace shizuku
{

namespace
{

const std::vector<std::string> sideWords{"open", "cyclic", "symmetryPlane"};        // as BoxSides::Kind has them

BoxSides::Kind readKind(const Dictionary& words, const std::string& side)
{
    const std::string word = words.lookupChoiceOr(side, sideWords, sideWords.front());
    return BoxSides::Kind(std::find(sideWords.begin(), sideWords.end(), word) - sideWords.begin());
}

}

std::optional<BoxSides> BoxSides::read(const std::filesystem::path& casePath)
{
    const auto file = casePath / "constant/boundary";
    if (!std::filesystem::exists(file)) return std::nullopt;
    const Dictionary dict = Dictionary::read(file);
    const Dictionary words = dict.subDict("sides");
    BoxSides sides;
    for (int k = 0; k < 3; ++k) sides.readAxis(dict, words, k);
    words.refuseUnused();
    dict.refuseUnused();
    return sides.has(Kind::cyclic) || sides.has(Kind::symmetryPlane) ? std::optional(sides) : std::nullopt;
}

void BoxSides::readAxis(const Dictionary& dict, const Dictionary& words, int k)
{
    const auto min = dict.lookupDimensionedVector("min", dimensions::length), max = dict.lookupDimensionedVector("max", dimensions::length);
    for (const bool upper : {false, true})
    {
        kind[k][upper] = readKind(words, name(k, upper));
        at[k][upper] = (upper ? max : min)[k];
        where[k][upper] = words.where(name(k, upper));
    }
    const bool lower = kind[k][0] == Kind::cyclic, upper = kind[k][1] == Kind::cyclic;
    if (lower != upper)
    {
        const std::string is = name(k, upper), isNot = name(k, lower);
        throw FatalInputError(where[k][upper], "The side " + is + " is cyclic, and " + isNot + " is not", is + " cyclic; " + isNot + " cyclic;");
    }
    const bool isOpen = kind[k][0] == Kind::open && kind[k][1] == Kind::open;
    if (isOpen || at[k][0] < at[k][1]) return;
    std::ostringstream found;
    found << "The sides " << name(k, false) << " and " << name(k, true) << " are at " << at[k][0] << " and " << at[k][1] << " m";
    throw FatalInputError(dict.where("max"), found.str(), "a component of min that is below that of max");
}

bool BoxSides::has(Kind any) const
{
    const auto isAny = [&](const Kind (&axis)[2]) { return axis[0] == any || axis[1] == any; };
    return std::any_of(std::begin(kind), std::end(kind), isAny);
}

}
