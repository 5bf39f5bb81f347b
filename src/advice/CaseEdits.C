// SPDX-License-Identifier: GPL-3.0-or-later
#include "advice/CaseEdits.H"

#include "core/dictionary/DictionaryEditor.H"
#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/EntryPath.H"
#include "core/fieldFile/AtomicFile.H"

#include <algorithm>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

bool isThere(const DictionaryEditor& editor, const std::string& entry)
{
    const auto beside = editor.keywordsBeside(entry);
    return std::find(beside.begin(), beside.end(), splitPath(entry).keyword) != beside.end();
}

void change(DictionaryEditor& editor, const CaseChange& change)
{
    const SplitPath path = splitPath(change.entry);
    if (isThere(editor, change.entry)) editor.set(change.entry, change.value);
    else if (path.dictionary.empty() || isThere(editor, path.dictionary)) editor.add(change.entry, change.value);
    else editor.add(path.dictionary, "{ " + path.keyword + " " + change.value + "; }");
}

fs::path oldName(const fs::path& file)
{
    fs::path name = file.string() + ".old";
    for (int i = 1; fs::exists(name); ++i) name = file.string() + ".old" + std::to_string(i);
    return name;
}

}

std::vector<fs::path> changeCase(const fs::path& casePath, const std::vector<CaseChange>& changes, bool keepOld)
{
    std::map<std::string, DictionaryEditor> editors;
    for (const CaseChange& each : changes)
    {
        const fs::path file = casePath/each.file;
        const auto editor = editors.try_emplace(each.file, DictionaryEditor(readText(file), file.string())).first;
        change(editor->second, each);
    }
    std::vector<fs::path> written;
    for (const auto& [name, editor] : editors)
    {
        const fs::path file = casePath/name;
        if (keepOld)
        {
            const std::string before = readText(file);
            writeAtomically(oldName(file), [&](std::ostream& stream) { stream << before; });
        }
        writeAtomically(file, [&, &text = editor.text()](std::ostream& stream) { stream << text; });
        written.push_back(file);
    }
    return written;
}

}
