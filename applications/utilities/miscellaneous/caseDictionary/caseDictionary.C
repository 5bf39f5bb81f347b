// SPDX-License-Identifier: GPL-3.0-or-later
// caseDictionary: prints and changes entries of any dictionary file.

#include "core/arguments/runApplication.H"
#include "core/dictionary/Dictionary.H"
#include "core/dictionary/DictionaryEditor.H"
#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/DictionaryJson.H"
#include "core/dictionary/DictionaryWriter.H"
#include "core/dictionary/EntryPath.H"
#include "core/dictionary/SetEntry.H"
#include "core/fieldFile/AtomicFile.H"

#include <algorithm>
#include <iostream>

using namespace shizuku;

namespace
{

const std::vector<std::string> changes{"set", "add", "remove"};
const std::vector<std::string> views{"value", "keywords", "json", "expand"};

bool anyOf(const Arguments& args, const std::vector<std::string>& options)
{
    return std::any_of(options.begin(), options.end(), [&](const auto& option) { return args.found(option); });
}

// At most one option of each kind, and never one of both.
void checkOptions(const Arguments& args)
{
    std::string first;
    for (const auto* kind : {&changes, &views})
    {
        for (const std::string& option : *kind)
        {
            if (!args.found(option)) continue;
            if (!first.empty())
            {
                throw FatalInputError({}, "-" + option + " and -" + first + " exclude each other", "one of them");
            }
            first = option;
        }
    }
    if (anyOf(args, {"set", "add", "remove", "value"}) && !args.found("entry"))
    {
        throw FatalInputError({}, "-" + first + " has no -entry", "-entry PATH, e.g. -entry floor.theta");
    }
    if (args.positional("dictionary").empty())
    {
        throw FatalInputError({}, "No dictionary is given",
            "caseDictionary FILE, e.g. caseDictionary system/controlDict");
    }
}

void change(const Arguments& args, const std::filesystem::path& file)
{
    DictionaryEditor editor(readText(file), file.string());
    const std::string path = args.get("entry");
    if (args.found("set")) setEntry(editor, path, args.get("set"), file.string());
    else if (args.found("add")) editor.add(path, args.get("add"));
    else editor.remove(path);
    writeAtomically(file, [&](std::ostream& stream) { stream << editor.text(); });
}

// The whole dictionary, or the entry of -entry.
Tree& selected(const Arguments& args, Tree& dictionary, const std::string& name)
{
    if (!args.found("entry")) return dictionary;
    const std::string path = args.get("entry");
    const std::vector<Tree*> entries = findEntries(dictionary, path);
    if (!entries.empty()) return *entries.back();
    if (Tree* entry = findByPatterns(dictionary, path)) return *entry;

    const SplitPath split = splitPath(path);
    const std::vector<Tree*> around =
        split.dictionary.empty() ? std::vector<Tree*>{&dictionary} : findEntries(dictionary, split.dictionary);
    std::vector<std::string> keywords;
    if (!around.empty())
    {
        for (const auto& [key, entry] : *around.back()) keywords.push_back(key);
    }
    throw FatalInputError({name, 0}, "There is no entry '" + path + "'", "an entry of the dictionary", keywords,
        split.keyword);
}

void print(const Arguments& args, const std::filesystem::path& file)
{
    const std::string text = readText(file);
    if (!args.found("entry") && !anyOf(args, views))
    {
        std::cout << text;
        return;
    }
    const auto root = expandDictionary(SourceText(text, file.string()));
    const Tree& node = selected(args, *root, file.string());
    const bool isDictionary = node.data().kind == NodeKind::dictionary;

    if (args.found("json")) writeJson(std::cout, node);
    else if (args.found("value")) writeValue(std::cout, node);
    else if (args.found("keywords"))
    {
        if (!isDictionary)
        {
            throw FatalInputError(node.data().where, "Entry '" + args.get("entry") + "' is no dictionary", "one");
        }
        for (const auto& [key, entry] : node) std::cout << key << '\n';
    }
    else if (&node == root.get()) writeEntries(std::cout, node);
    else writeEntry(std::cout, node);
}

}

int main(int argc, char** argv)
{
    const ApplicationInfo info
    {
        "caseDictionary",
        "Print or change entries of a dictionary file. Without options it prints the file. "
        "Changes keep comments, order and layout.",
        {
            {"entry", "PATH", "The entry, e.g. floor.theta or solvers/p; macros in it are expanded", ""},
            {"value", "", "Print the value alone", ""},
            {"keywords", "", "Print the keywords of the dictionary or of the entry", ""},
            {"json", "", "Print as JSON", ""},
            {"expand", "", "Print the file with macros and directives expanded", ""},
            {"set", "VALUE", "Give the entry a new value, e.g. 60 or '{ theta 60; }'", ""},
            {"add", "VALUE", "Add the entry with this value", ""},
            {"remove", "", "Remove the entry", ""}
        },
        {"dictionary"},
        false
    };
    return runApplication
    (
        argc, argv, info,
        [](const Arguments& args)
        {
            checkOptions(args);
            const std::filesystem::path file = (args.casePath()/args.positional("dictionary")).lexically_normal();
            if (anyOf(args, changes)) change(args, file);
            else print(args, file);
        },
        true
    );
}
