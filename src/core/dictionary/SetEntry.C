// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/SetEntry.H"

#include "core/dictionary/DictionaryEditor.H"
#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/DictionaryGrammar.H"
#include "core/dictionary/EntryPath.H"
#include "core/messages/Error.H"

namespace shizuku
{

namespace
{

// The entry comes from an included file or a macro: it is written behind them, where it counts, dictionaries around it included.
void overrideEntry(DictionaryEditor& editor, Tree& written, std::string path, std::string value)
{
    SplitPath split = splitPath(path);
    while (!split.dictionary.empty() && findEntries(written, split.dictionary).empty())
    {
        value = "{ " + split.keyword + " " + value + (value.starts_with('{') ? " }" : "; }");
        path = split.dictionary;
        split = splitPath(path);
    }
    editor.add(path, value);
}

// The one token of an entry's value; nullptr of what has none, or several.
const Tree* onlyItem(const Tree& entry)
{
    return entry.data().kind == NodeKind::entry && entry.size() == 1 ? &entry.front().second : nullptr;
}

// A word in place of a number is a slip more often than not. (Macros and #calc are neither.)
void warnOfWord(Tree& before, Tree& after, const std::string& path)
{
    const std::vector<Tree*> old = findEntries(before, path), now = findEntries(after, path);
    const Tree* const was = old.empty() ? nullptr : onlyItem(*old.back());
    const Tree* const is = now.empty() ? nullptr : onlyItem(*now.back());
    if (!was || !is || was->data().kind != NodeKind::number || is->data().kind != NodeKind::word) return;
    warning("Entry '" + path + "' was the number " + was->data().text + ", and is the word '" + is->data().text + "' now", is->data().where);
}

}

void setEntry(DictionaryEditor& editor, const std::string& path, const std::string& value, const std::string& name)
{
    Tree written = parseSyntax(SourceText(editor.text(), name));
    const bool isGivenElsewhere = findEntries(written, path).empty()
        && !findEntries(*expandDictionary(SourceText(editor.text(), name)), path).empty();
    if (isGivenElsewhere) overrideEntry(editor, written, path, value);
    else editor.set(path, value);
    Tree changed = parseSyntax(SourceText(editor.text(), name));
    warnOfWord(written, changed, path);
}

}
