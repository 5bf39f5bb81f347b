// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/Dictionary.H"
#include "core/dictionary/DictionaryNode.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// A pattern for all that have no entry of their own is no mistake where each has one.
bool isOverridden(const NodeData& entry, const std::set<std::string>& asked)
{
    if (entry.style != KeywordStyle::pattern) return false;
    return std::any_of(asked.begin(), asked.end(), [&](const std::string& word) { return patternMatches(entry, word); });
}

void refuseUnusedBelow(const Tree& dictionary, const std::string& name)
{
    for (const auto& [key, entry] : dictionary)
    {
        const NodeData& data = entry.data();
        if (key == "FoamFile" || key.starts_with('_')) continue;
        if (!data.used && !isOverridden(data, dictionary.data().asked))
        {
            const std::set<std::string>& asked = dictionary.data().asked;
            throw FatalInputError
            (
                data.where, "Unknown entry '" + key + "' in dictionary \"" + name + "\": nothing reads it",
                "one of the keywords below", {asked.begin(), asked.end()}, key
            );
        }
        if (data.used && data.kind == NodeKind::dictionary) refuseUnusedBelow(entry, name + "/" + key);
    }
}

}

void Dictionary::refuseUnused() const
{
    refuseUnusedBelow(*node_->tree, node_->name);
}

void Dictionary::markUsed() const
{
    shizuku::markUsed(*node_->tree);
}

}
