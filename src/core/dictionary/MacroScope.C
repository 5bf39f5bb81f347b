#include "core/dictionary/MacroScope.H"

#include <algorithm>

namespace shizuku
{

namespace
{

const char* const separators = "./";

// The entry at "a.b.c" below a dictionary; a keyword may hold dots itself (alpha.water).
Tree* findPath(Tree& dictionary, const std::string& path)
{
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
        if (Tree* entry = findPath(*outer, path.substr(dot + 1)))
        {
            outer->data().used = true;
            return entry;
        }
    }
    return nullptr;
}

}

// A dictionary is attached to the one around it only when it is complete, so the open ones are tried by keyword.
Tree* MacroScope::findFrom(std::size_t level, const std::string& path) const
{
    if (Tree* entry = findPath(*levels_[level].dictionary, path)) return entry;
    if (level + 1 == levels_.size()) return nullptr;
    const std::string& inner = levels_[level + 1].keyword;
    const bool leadsInwards = path.size() > inner.size() + 1 && path.starts_with(inner)
        && (path[inner.size()] == '.' || path[inner.size()] == '/');
    return leadsInwards ? findFrom(level + 1, path.substr(inner.size() + 1)) : nullptr;
}

Tree* MacroScope::find(const std::string& name) const
{
    if (name.starts_with(':') || name.starts_with('/')) return findFrom(0, name.substr(1));

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
        return findFrom(level, path.substr(dots));
    }

    for (;; --level)
    {
        if (Tree* entry = findFrom(level, name)) return entry;
        if (level == 0) return nullptr;
    }
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
