#include "meshes/PatchedSurface.H"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <map>
#include <set>

namespace shizuku
{

namespace
{

std::string asWord(std::string name)
{
    for (char& c : name)
    {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) || std::strchr("_-.+:", c);
        if (!plain) c = '_';
    }
    return name;
}

std::string firstWord(const std::string& name) { return name.substr(0, name.find(' ')); }

}

int PatchedSurface::patchIndex(const std::string& name)
{
    const auto found = std::find(patches.begin(), patches.end(), name);
    if (found != patches.end()) return static_cast<int>(found - patches.begin());
    patches.push_back(name);
    return static_cast<int>(patches.size()) - 1;
}

std::vector<std::string> PatchedSurface::makePatchNamesWords()
{
    std::map<std::string, int> beginnings;
    for (const std::string& name : patches) ++beginnings[firstWord(name)];
    std::vector<std::string> words;
    std::map<std::string, int> alike;
    for (const std::string& name : patches)
    {
        words.push_back(asWord(beginnings[firstWord(name)] == 1 ? firstWord(name) : name));
        ++alike[words.back()];
    }

    // Names that are words already stay as they are, whatever the order in the file.
    std::set<std::string> taken;
    for (std::size_t p = 0; p < patches.size(); ++p) if (words[p] == patches[p]) taken.insert(words[p]);
    std::vector<std::string> report;
    for (std::size_t p = 0; p < patches.size(); ++p)
    {
        if (words[p] == patches[p] || taken.insert(words[p]).second) continue;
        int number = 2;
        const auto numbered = [&] { return words[p] + "_" + std::to_string(number); };
        while (taken.contains(numbered()) || alike.contains(numbered())) ++number;
        words[p] = numbered();
        taken.insert(words[p]);
        report.push_back("the patch '" + patches[p] + "' is called " + words[p] + ": another one would have the same name");
    }
    patches = words;
    return report;
}

}
