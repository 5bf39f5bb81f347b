// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/DictionaryTree.H"

#include "core/dictionary/KeywordPattern.H"

#include <iterator>
#include <map>

namespace shizuku
{

bool patternMatches(const NodeData& pattern, const std::string& word)
{
    constexpr std::size_t kept = 1000;
    static thread_local std::map<std::string, KeywordPattern> patterns;     // the same few are asked for again and again
    auto found = patterns.find(pattern.text);
    if (found == patterns.end())
    {
        if (patterns.size() == kept) patterns.clear();
        found = patterns.emplace(pattern.text, KeywordPattern(pattern.text, pattern.where)).first;
    }
    return found->second.matches(word);
}

Tree* findSameKeyword(Tree& dictionary, const std::string& keyword, KeywordStyle style)
{
    const auto [first, last] = dictionary.equal_range(keyword);
    for (auto entry = first; entry != last; ++entry)
    {
        if (entry->second.data().style == style) return &entry->second;
    }
    return nullptr;
}

Tree* findEntry(Tree& dictionary, const std::string& key)
{
    if (Tree* exact = findSameKeyword(dictionary, key, KeywordStyle::word)) return exact;
    if (Tree* same = findSameKeyword(dictionary, key, KeywordStyle::pattern)) return same;
    for (auto entry = dictionary.rbegin(); entry != dictionary.rend(); ++entry)
    {
        const NodeData& data = entry->second.data();
        if (data.style == KeywordStyle::pattern && patternMatches(data, key)) return &entry->second;
    }
    return nullptr;
}

void markUsed(Tree& node)
{
    node.data().used = true;
    for (auto& [key, child] : node) markUsed(child);
}

std::string describe(const Tree& item)
{
    const NodeData& data = item.data();
    switch (data.kind)
    {
        case NodeKind::dictionary: return "a dictionary";
        case NodeKind::entry: return "the entry '" + data.text + "'";
        case NodeKind::directive: return "#" + data.text;
        case NodeKind::macro: return "$" + data.text;
        case NodeKind::word: return "the word '" + data.text + "'";
        case NodeKind::number: return "the number " + data.text;
        case NodeKind::string: return "the string \"" + data.text + "\"";
        case NodeKind::verbatim: return "verbatim text";
        case NodeKind::dimensions: return "dimensions [" + data.text + "]";
        case NodeKind::list:
        case NodeKind::uniformList: return "a list";
    }
    return "";
}

}
