// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/EntryPath.H"

namespace shizuku
{

namespace
{

// The next separator outside quotes.
std::size_t nextSeparator(const std::string& path, std::size_t from, const char* separators)
{
    bool inQuotes = false;
    for (std::size_t i = 0; i < path.size(); ++i)
    {
        if (path[i] == '"') inQuotes = !inQuotes;
        if (i >= from && !inQuotes && std::string(separators).find(path[i]) != std::string::npos) return i;
    }
    return std::string::npos;
}

const char* separatorsOf(const std::string& path)
{
    return nextSeparator(path, 0, "/") == std::string::npos ? "." : "/";
}

std::string withoutQuotes(const std::string& keyword)
{
    const bool quoted = keyword.size() > 1 && keyword.front() == '"' && keyword.back() == '"';
    return quoted ? keyword.substr(1, keyword.size() - 2) : keyword;
}

void collect(Tree& dictionary, const std::string& path, const char* separators, std::vector<Tree*>& found)
{
    const std::string keyword = withoutQuotes(path);
    for (auto& [key, entry] : dictionary)
    {
        if (!key.empty() && key == keyword) found.push_back(&entry);
    }
    std::size_t at = nextSeparator(path, 0, separators);
    for (; at != std::string::npos; at = nextSeparator(path, at + 1, separators))
    {
        const std::string outer = withoutQuotes(path.substr(0, at));
        for (auto& [key, entry] : dictionary)
        {
            const bool leads = key == outer && entry.data().kind == NodeKind::dictionary;
            if (leads) collect(entry, path.substr(at + 1), separators, found);
        }
    }
}

}

std::vector<Tree*> findEntries(Tree& dictionary, const std::string& path)
{
    std::vector<Tree*> found;
    collect(dictionary, path, separatorsOf(path), found);
    return found;
}

Tree* findByPatterns(Tree& dictionary, const std::string& path)
{
    const char* separators = separatorsOf(path);
    std::size_t at = nextSeparator(path, 0, separators);
    for (; at != std::string::npos; at = nextSeparator(path, at + 1, separators))
    {
        Tree* outer = findEntry(dictionary, withoutQuotes(path.substr(0, at)));
        if (!outer || outer->data().kind != NodeKind::dictionary) continue;
        if (Tree* entry = findByPatterns(*outer, path.substr(at + 1))) return entry;
    }
    return findEntry(dictionary, withoutQuotes(path));
}

SplitPath splitPath(const std::string& path)
{
    const char* separators = separatorsOf(path);
    std::size_t last = std::string::npos;
    std::size_t at = nextSeparator(path, 0, separators);
    for (; at != std::string::npos; at = nextSeparator(path, at + 1, separators))
    {
        last = at;
    }
    if (last == std::string::npos) return {"", path};
    return {path.substr(0, last), path.substr(last + 1)};
}

}
