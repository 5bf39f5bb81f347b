// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/Dictionary.H"
#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/DictionaryNode.H"

namespace shizuku
{

Dictionary::Dictionary() : node_(std::make_shared<Node>(Node{std::make_shared<Tree>(), ""})) {}

Dictionary::Dictionary(std::shared_ptr<Node> node) : node_(std::move(node)) {}

Dictionary Dictionary::read(const std::filesystem::path& file)
{
    return parse(readText(file), file.lexically_normal().string());
}

Dictionary Dictionary::parse(const std::string& text, const std::string& name)
{
    return DictionaryAccess::make(expandDictionary(SourceText(text, name)), name);
}

namespace
{

// A slip of the hand: of the entries that nothing has asked for, the one whose keyword is near.
std::string misspelt(const Dictionary& dictionary, const std::string& key)
{
    std::vector<std::string> unasked = dictionary.keys();
    const std::set<std::string>& asked = DictionaryAccess::tree(dictionary).data().asked;
    std::erase_if(unasked, [&](const std::string& each) { return asked.contains(each); });
    return nearestWord(key, unasked);
}

std::string list(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

}

Tree& requireEntry(const Dictionary& dictionary, const std::string& key)
{
    if (!dictionary.found(key))
    {
        const std::string name = "dictionary \"" + dictionary.name() + "\"";
        if (const std::string wrong = misspelt(dictionary, key); !wrong.empty())
        {
            throw FatalInputError
            (
                dictionary.where(wrong), "Entry '" + wrong + "' in " + name + ": did you mean '" + key + "'? That is missing",
                "'" + key + "' in place of '" + wrong + "', or beside it"
            );
        }
        const std::string there = list(dictionary.keys());
        throw FatalInputError
        (
            dictionary.where(), "Entry '" + key + "' is missing in " + name,
            "'" + key + "'" + (there.empty() ? ": the dictionary is empty" : " beside the entries that are there: " + there)
        );
    }
    return *findEntry(DictionaryAccess::tree(dictionary), key);
}

Dictionary Dictionary::subDict(const std::string& key) const
{
    Tree& entry = requireEntry(*this, key);
    if (!isDict(key))
    {
        throw FatalInputError(where(key), "Entry '" + key + "' is no dictionary", key + " { ... }");
    }
    const std::string name = node_->name.empty() ? key : node_->name + "/" + key;
    return DictionaryAccess::make(std::shared_ptr<Tree>(node_->tree, &entry), name);
}

Dictionary Dictionary::subDictOrEmpty(const std::string& key) const
{
    if (found(key)) return subDict(key);
    auto empty = std::make_shared<Tree>();
    empty->data().where = where();
    return DictionaryAccess::make(empty, node_->name.empty() ? key : node_->name + "/" + key);
}

bool Dictionary::found(const std::string& key) const
{
    node_->tree->data().asked.insert(key);
    Tree* entry = findEntry(*node_->tree, key);
    if (entry) entry->data().used = true;
    return entry;
}

bool Dictionary::isDict(const std::string& key) const
{
    const Tree* entry = findEntry(*node_->tree, key);
    return entry && entry->data().kind == NodeKind::dictionary;
}

std::vector<std::string> Dictionary::keys() const
{
    std::vector<std::string> result;
    for (const auto& [key, entry] : *node_->tree)
    {
        if (key != "FoamFile") result.push_back(key);
    }
    return result;
}

std::vector<std::string> Dictionary::dictKeys() const
{
    std::vector<std::string> result = keys();
    std::erase_if(result, [this](const std::string& key) { return !isDict(key); });
    return result;
}

SourceLocation Dictionary::where(const std::string& key) const
{
    const Tree* entry = findEntry(*node_->tree, key);
    return entry ? entry->data().where : where();
}

SourceLocation Dictionary::where() const
{
    return node_->tree->data().where;
}

std::string Dictionary::name() const
{
    return node_->name;
}

}
