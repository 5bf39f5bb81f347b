// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/MacroScope.H"

#include "core/dictionary/InputLimits.H"

#include <algorithm>

namespace shizuku
{

namespace
{

const char* const separators = "./";

// The entry at "a.b.c" below a dictionary; a keyword may hold dots itself (alpha.water).
Tree* findPath(Tree& dictionary, const std::string& path, std::size_t& ways)
{
    if (ways == 0) return nullptr;
    --ways;
    if (Tree* entry = findEntry(dictionary, path))
    {
        if (entry->data().kind == NodeKind::dictionary) markUsed(*entry);
        entry->data().used = true;
        return entry;
    }
    std::size_t dot = path.find_first_of(separators);
    for (; dot != std::string::npos; dot = path.find_first_of(separators, dot + 1))
    {
        Tree* outer = findEntry(dictionary, path.substr(0, dot));
        if (!outer || outer->data().kind != NodeKind::dictionary) continue;
        if (Tree* entry = findPath(*outer, path.substr(dot + 1), ways))
        {
            outer->data().used = true;
            return entry;
        }
    }
    return nullptr;
}

}

// A dictionary is attached to the one around it only when it is complete, so the open ones are tried by keyword.
Tree* MacroScope::findFrom(std::size_t level, const std::string& path, std::size_t& ways) const
{
    if (Tree* entry = findPath(*levels_[level].dictionary, path, ways)) return entry;
    if (level + 1 == levels_.size()) return nullptr;
    const std::string& inner = levels_[level + 1].keyword;
    const bool leadsInwards = path.size() > inner.size() + 1 && path.starts_with(inner)
        && (path[inner.size()] == '.' || path[inner.size()] == '/');
    return leadsInwards ? findFrom(level + 1, path.substr(inner.size() + 1), ways) : nullptr;
}

Tree* MacroScope::find(const std::string& name, const SourceLocation& where) const
{
    std::size_t ways = inputLimits::macroReadings;
    Tree* found = findWithin(name, ways);
    if (ways == 0)
    {
        throw FatalInputError(where, "$" + name.substr(0, 60) + "... can be read in too many ways",
            "at most " + std::to_string(inputLimits::macroReadings) + " ways to divide a name at its dots");
    }
    return found;
}

Tree* MacroScope::findWithin(const std::string& name, std::size_t& ways) const
{
    if (name.find_first_of(":/!") == 0) return findFrom(0, name.substr(1), ways);

    std::size_t level = levels_.size() - 1;
    if (name.starts_with('.'))
    {
        std::string path = name;
        while (path.starts_with("../"))
        {
            if (level-- == 0) return nullptr;
            path = path.substr(3);
        }
        const std::size_t dots = std::min(path.find_first_not_of('.'), path.size());
        if (dots > level + 1) return nullptr;
        if (dots > 1) level -= dots - 1;
        return findFrom(level, path.substr(dots), ways);
    }

    for (;; --level)
    {
        if (Tree* entry = findFrom(level, name, ways)) return entry;
        if (level == 0) return nullptr;
    }
}

std::size_t MacroScope::cost() const
{
    constexpr std::size_t costOfPattern = 50;
    std::size_t cost = 0;
    for (const Level& level : levels_)
    {
        for (const auto& [key, entry] : *level.dictionary)
        {
            cost += entry.data().style == KeywordStyle::pattern ? costOfPattern : 1;
        }
    }
    return cost;
}

std::vector<std::string> MacroScope::visible() const
{
    std::vector<std::string> result;
    for (const Level& level : levels_)
    {
        for (const auto& [key, entry] : *level.dictionary)
        {
            if (key != "FoamFile" && entry.data().style == KeywordStyle::word) result.push_back(key);
        }
    }
    return result;
}

}
