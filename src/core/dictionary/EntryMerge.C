// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/EntryMerge.H"

namespace shizuku
{

namespace
{

std::string duplicateOf(const Tree& first)
{
    const SourceLocation& where = first.data().where;
    return "Entry '" + first.data().text + "' is there already, at line " + std::to_string(where.line)
        + " of " + where.file;
}

void replace(Tree& old, const Tree& entry, InputMode mode)
{
    const bool bothDictionaries = old.data().kind == NodeKind::dictionary && entry.data().kind == NodeKind::dictionary;
    if (mode == InputMode::merge && bothDictionaries)
    {
        for (const auto& [key, child] : entry) mergeEntry(old, child, mode);
        return;
    }
    const bool used = old.data().used;      // a macro has taken the old value
    old = entry;
    old.data().used = old.data().used || used;
}

}

void mergeEntry(Tree& dictionary, const Tree& entry, InputMode mode)
{
    const NodeData& data = entry.data();
    Tree* old = findSameKeyword(dictionary, data.text, data.style);
    if (!old)
    {
        dictionary.push_back({data.text, entry});
        return;
    }
    switch (mode)
    {
        case InputMode::merge:
        case InputMode::overwrite: replace(*old, entry, mode); break;
        case InputMode::protect: break;
        case InputMode::warn: warning(duplicateOf(*old) + "; this one is ignored", data.where); break;
        case InputMode::error:
            throw FatalInputError(data.where, duplicateOf(*old), "each keyword once, because of #inputMode error");
    }
}

}
