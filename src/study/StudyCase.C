// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/StudyCase.H"

#include "core/dictionary/DictionaryEditor.H"
#include "core/dictionary/DictionaryWriter.H"
#include "core/dictionary/EntryPath.H"
#include "core/dictionary/EntryText.H"
#include "core/fieldFile/AtomicFile.H"
#include "core/paths/Existence.H"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

using Words = std::map<std::string, std::string>;

std::vector<const CaseChoice*> choicesOf(const Study& study, const StudyRun& run)
{
    std::vector<const CaseChoice*> choices{&study.common};
    for (std::size_t i = 0; i < study.axes.size(); ++i) choices.push_back(&study.axes[i].choices[run.choices[i]]);
    return choices;
}

// As it may stand in a dictionary: words, numbers and lists as they are, any other text in quotes.
std::string asEntry(const std::string& text)
{
    const bool plain = !text.empty() && text.find_first_of(" \t\n;{}\"'$#") == std::string::npos;
    return plain || text.starts_with('(') ? text : quotedText(text);
}

// valuesFile with the choices' words in front, the last choice first: what comes first stays.
Words wordsOf(const Study& study, const std::vector<const CaseChoice*>& choices)
{
    std::ostringstream text;
    text << "#inputMode protect\n";
    for (auto choice = choices.rbegin(); choice != choices.rend(); ++choice)
    {
        for (const auto& [word, value] : (*choice)->values)
        {
            text << word << ' ' << asEntry(value.text) << ";\n";
        }
    }
    text << "#include \"" << study.valuesFile.string() << "\"\n";
    const Dictionary values = Dictionary::parse(text.str(), (study.folder/"the choices of a run").string());
    Words words;
    for (const std::string& word : values.keys())
    {
        if (!values.isDict(word)) words[word] = entryText(values, word);
    }
    return words;
}

std::string readFile(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void addFolder(StudyCase& result, const Study& study, const StudyText& given, const std::string& to)
{
    const fs::path folder = (study.folder/withWords(given.text, result.values, given.where)).lexically_normal();
    if (!isFolder(folder))
    {
        throw FatalInputError(given.where, "There is no folder " + folder.string(), "a folder, from that of the study on");
    }
    for (const auto& entry : fs::recursive_directory_iterator(folder))
    {
        if (!entry.is_regular_file()) continue;
        const std::string name = (fs::path(to)/fs::relative(entry.path(), folder)).generic_string();
        result.files[name] =
            {withWords(readFile(entry.path()), result.values, {entry.path().string(), 0}), entry.status().permissions()};
    }
}

void setEntry(StudyCase& result, const CaseChoice::Entry& entry)
{
    const auto file = result.files.find(entry.file);
    if (file == result.files.end())
    {
        std::vector<std::string> names;
        for (const auto& [name, each] : result.files) names.push_back(name);
        throw FatalInputError
        (
            entry.value.where, "The case has no file '" + entry.file + "'", "a file of the case", names, entry.file
        );
    }
    DictionaryEditor editor(file->second.text, entry.file);
    const std::vector<std::string> beside = editor.keywordsBeside(entry.entry);
    const std::string keyword = splitPath(entry.entry).keyword;
    if (std::find(beside.begin(), beside.end(), keyword) == beside.end())
    {
        throw FatalInputError
        (
            entry.value.where, "The case's " + entry.file + " has no entry '" + entry.entry + "'", "one that is written there",
            beside, keyword
        );
    }
    editor.set(entry.entry, withWords(entry.value.text, result.values, entry.value.where));
    file->second.text = editor.text();
}

}

std::string withWords(const std::string& text, const Words& words, const SourceLocation& where)
{
    static const std::regex pattern("@([A-Za-z][A-Za-z0-9]*)@");
    std::string result;
    auto from = text.cbegin();
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    {
        result.append(from, (*match)[0].first);
        from = (*match)[0].second;
        const auto word = words.find((*match)[1]);
        if (word == words.end())
        {
            std::vector<std::string> known;
            for (const auto& [name, value] : words) known.push_back(name);
            const int line = where.line > 0 ? where.line : 1 + int(std::count(text.cbegin(), (*match)[0].first, '\n'));
            throw FatalInputError
            (
                {where.file, line}, "The word " + match->str() + " has no value", "one of valuesFile", known, (*match)[1]
            );
        }
        result += word->second;
    }
    result.append(from, text.cend());
    return result;
}

double numberOf(const StudyText& text, const Words& values)
{
    const std::string number = withWords(text.text, values, text.where);
    double value = 0;
    const auto [end, status] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (status == std::errc() && end == number.data() + number.size()) return value;
    throw FatalInputError(text.where, "'" + number + "' is no number", "a number, or a word @theta@ of the case that is one");
}

std::string StudyCase::digest() const
{
    // Fowler, Noll and Vo, 64 bit, variant 1a.
    std::uint64_t hash = 14695981039346656037ull;
    const auto add = [&](const std::string& text)
    {
        for (const char c : text + '\0') hash = (hash ^ static_cast<unsigned char>(c))*1099511628211ull;
    };
    for (const auto& [name, file] : files)
    {
        add(name);
        add(file.text);
    }
    std::ostringstream text;
    text << std::hex << hash;
    return text.str();
}

void StudyCase::write(const fs::path& folder) const
{
    fs::remove_all(folder);
    writeFolderAtomically(folder, [&](const fs::path& to)
    {
        for (const auto& [name, file] : files)
        {
            fs::create_directories((to/name).parent_path());
            std::ofstream stream(to/name, std::ios::binary);
            stream << file.text;
            if (!stream.flush()) throw FatalError("Cannot write " + (to/name).string());
            fs::permissions(to/name, file.permissions | fs::perms::owner_write);
        }
    });
}

StudyCase composeCase(const Study& study, const StudyRun& run)
{
    const std::vector<const CaseChoice*> choices = choicesOf(study, run);
    StudyCase result;
    result.values = wordsOf(study, choices);
    for (const CaseChoice* choice : choices)
    {
        for (const StudyText& layer : choice->layers) addFolder(result, study, layer, "");
    }
    for (const CaseChoice* choice : choices)
    {
        for (const auto& [to, from] : choice->folders) addFolder(result, study, from, to);
    }
    for (const CaseChoice* choice : choices)
    {
        for (const CaseChoice::Entry& entry : choice->entries) setEntry(result, entry);
    }
    return result;
}

}
