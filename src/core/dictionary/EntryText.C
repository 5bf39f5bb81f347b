// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/EntryText.H"

#include "core/dictionary/DictionaryNode.H"
#include "core/dictionary/DictionaryWriter.H"

namespace shizuku
{

namespace
{

std::string textOf(const Tree& entry)
{
    if (entry.size() == 1 && entry.front().second.data().kind == NodeKind::string) return entry.front().second.data().text;
    const std::string text = valueText(entry);
    return entry.data().kind == NodeKind::dictionary ? "{\n" + text + "\n}" : text;
}

}

std::string entryText(const Dictionary& dictionary, const std::string& key)
{
    Tree& entry = requireEntry(dictionary, key);
    markUsed(entry);
    return textOf(entry);
}

std::vector<std::string> listTexts(const Dictionary& dictionary, const std::string& key)
{
    Tree& entry = requireEntry(dictionary, key);
    markUsed(entry);
    if (entry.data().kind == NodeKind::dictionary || entry.size() != 1 || entry.front().second.data().kind != NodeKind::list)
    {
        throw FatalInputError(entry.data().where, "Entry '" + key + "' is no list", "a list ( .. ) of words, numbers or strings");
    }
    std::vector<std::string> texts;
    for (const auto& [none, item] : entry.front().second)
    {
        Tree single(NodeData{NodeKind::entry, key, KeywordStyle::word, entry.data().where, {}, {}, true, {}});
        single.push_back({"", item});
        texts.push_back(textOf(single));
    }
    return texts;
}

}
