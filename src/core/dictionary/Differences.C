// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/Differences.H"

#include "core/dictionary/DictionaryNode.H"
#include "core/dictionary/DictionaryWriter.H"

namespace shizuku
{

namespace
{

bool isDictionary(const Tree* entry)
{
    return entry && entry->data().kind == NodeKind::dictionary;
}

void compare(Tree* before, Tree* after, const std::string& path, std::vector<EntryChange>& changes);

// The entries of two dictionaries, either of which may be absent.
void compareEntries(Tree* before, Tree* after, const std::string& path, std::vector<EntryChange>& changes)
{
    const auto visit = [&](Tree& dictionary, bool onlyNew)
    {
        for (const auto& [key, entry] : dictionary)
        {
            const auto find = [&key = key, &entry = entry](Tree* tree) { return tree ? findSameKeyword(*tree, key, entry.data().style) : nullptr; };
            if (onlyNew && find(before)) continue;
            compare(find(before), find(after), path.empty() ? key : path + "." + key, changes);
        }
    };
    if (before) visit(*before, false);
    if (after) visit(*after, true);
}

void compare(Tree* before, Tree* after, const std::string& path, std::vector<EntryChange>& changes)
{
    if ((isDictionary(before) || !before) && (isDictionary(after) || !after)) return compareEntries(before, after, path, changes);
    const std::string first = before ? valueText(*before) : "absent", second = after ? valueText(*after) : "absent";
    if (first != second) changes.push_back({path, first, second});
}

}

std::vector<EntryChange> differences(const Dictionary& before, const Dictionary& after)
{
    std::vector<EntryChange> changes;
    compareEntries(&DictionaryAccess::tree(before), &DictionaryAccess::tree(after), "", changes);
    return changes;
}

}
