#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/CalcExpression.H"
#include "core/dictionary/DictionaryGrammar.H"
#include "core/dictionary/EntryMerge.H"
#include "core/dictionary/IncludeFile.H"
#include "core/dictionary/MacroScope.H"
#include "core/dictionary/ValueReader.H"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <vector>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

// Entries taken over by a macro have not been looked up yet.
Tree unused(Tree node)
{
    node.data().used = false;
    node.data().asked.clear();
    for (auto& [key, child] : node) child = unused(child);
    return node;
}

class Expansion
{
public:
    explicit Expansion(Tree& root) : scope_(root) {}

    // Adds what the statements of a file expand to to the innermost open dictionary.
    void addFile(const SourceText& source);

private:
    void addStatements(const Tree& syntax);
    void addEntry(const Tree& syntax);
    void addMacro(const Tree& macro);
    void addDirective(const Tree& directive);
    std::string keywordOf(const Tree& syntax) const;
    Tree expandedBody(const std::string& keyword, const Tree& syntax);

    // Adds what an item expands to: nothing, one or several items.
    void addItem(Tree& value, const Tree& item);
    void addMacroItems(Tree& value, const Tree& macro);
    void addDirectiveItems(Tree& value, const Tree& directive);

    // What a macro names: an entry or a dictionary, or the items of ${name:-default} or of the environment.
    Tree resolve(const std::string& name, const SourceLocation& where) const;
    double number(const std::string& macro, const SourceLocation& where) const;
    std::string withMacros(const std::string& text, const SourceLocation& where) const;

    void include(const Tree& directive, const std::function<void(const SourceText&)>& take);
    void setInputMode(const Tree& directive);
    void remove(const Tree& selection);

    MacroScope scope_;
    std::vector<fs::path> files_;       // that include one another, the innermost last
    InputMode mode_ = InputMode::merge;
};

const Tree& argumentOf(const Tree& directive)
{
    if (directive.empty())
    {
        throw FatalInputError(directive.data().where, "#" + directive.data().text + " stands alone", "something behind it");
    }
    return directive.front().second;
}

const std::string& textArgumentOf(const Tree& directive, const std::string& expected)
{
    const NodeData& data = argumentOf(directive).data();
    if (data.kind != NodeKind::string && data.kind != NodeKind::word && data.kind != NodeKind::verbatim)
    {
        throw FatalInputError(data.where, "#" + directive.data().text + " is followed by " + describe(argumentOf(directive)), expected);
    }
    return data.text;
}

[[noreturn]] void failDirective(const Tree& directive, const std::string& place, const std::vector<std::string>& choices)
{
    const NodeData& data = directive.data();
    throw FatalInputError(data.where, "#" + data.text + " is unknown " + place, "one of the directives below", choices, data.text);
}

// ---- Statements

void Expansion::addFile(const SourceText& source)
{
    files_.push_back(source.name());
    addStatements(parseSyntax(source));
    files_.pop_back();
}

void Expansion::addStatements(const Tree& syntax)
{
    for (const auto& [key, statement] : syntax)
    {
        const bool header = key == "FoamFile" && files_.size() > 1;     // of an included file
        switch (statement.data().kind)
        {
            case NodeKind::macro: addMacro(statement); break;
            case NodeKind::directive: addDirective(statement); break;
            default: if (!header) addEntry(statement);
        }
    }
}

std::string Expansion::keywordOf(const Tree& syntax) const
{
    const NodeData& data = syntax.data();
    if (data.style != KeywordStyle::macro) return data.text;
    ValueReader reader(resolve(data.text, data.where), "one word, to be a keyword");
    const std::string keyword = reader.read<std::string>();
    reader.finish();
    return keyword;
}

Tree Expansion::expandedBody(const std::string& keyword, const Tree& syntax)
{
    Tree body(syntax.data());
    scope_.open(keyword, body);
    addStatements(syntax);
    scope_.close();
    return body;
}

void Expansion::addEntry(const Tree& syntax)
{
    Tree entry(syntax.data());
    const std::string keyword = keywordOf(syntax);
    if (syntax.data().kind == NodeKind::dictionary)
    {
        entry = expandedBody(keyword, syntax);
    }
    else
    {
        for (const auto& [key, item] : syntax) addItem(entry, item);
        if (entry.size() == 1 && entry.front().second.data().kind == NodeKind::dictionary)      // keyword $dictionary;
        {
            entry = Tree(entry.front().second);
            entry.data().where = syntax.data().where;
        }
    }
    entry.data().text = keyword;
    entry.data().style = syntax.data().style == KeywordStyle::pattern ? KeywordStyle::pattern : KeywordStyle::word;
    mergeEntry(scope_.current(), entry, mode_);
}

void Expansion::addMacro(const Tree& macro)
{
    const NodeData& data = macro.data();
    const Tree source = resolve(data.text, data.where);
    if (source.data().kind != NodeKind::dictionary)
    {
        throw FatalInputError(data.where, "$" + data.text + " is no dictionary", "$dictionary; or keyword $" + data.text + ";");
    }
    for (const auto& [key, entry] : source) mergeEntry(scope_.current(), entry, mode_);
}

void Expansion::addDirective(const Tree& directive)
{
    using Action = std::function<void(Expansion&, const Tree&)>;
    const Action addIncluded = [](Expansion& expansion, const Tree& argument)
    {
        expansion.include(argument, [&](const SourceText& source) { expansion.addFile(source); });
    };
    const std::map<std::string, Action> actions
    {
        {"include", addIncluded},
        {"includeEtc", addIncluded},
        {"includeIfPresent", addIncluded},
        {"inputMode", [](Expansion& expansion, const Tree& argument) { expansion.setInputMode(argument); }},
        {"remove", [](Expansion& expansion, const Tree& argument) { expansion.remove(argumentOf(argument)); }}
    };
    const auto action = actions.find(directive.data().text);
    if (action == actions.end())
    {
        failDirective(directive, "as a statement", {"include", "includeEtc", "includeIfPresent", "inputMode", "remove"});
    }
    action->second(*this, directive);
}

void Expansion::setInputMode(const Tree& directive)
{
    static const std::map<std::string, InputMode> modes
    {
        {"default", InputMode::merge}, {"merge", InputMode::merge}, {"overwrite", InputMode::overwrite},
        {"protect", InputMode::protect}, {"warn", InputMode::warn}, {"error", InputMode::error}
    };
    const std::string& word = textArgumentOf(directive, "a word");
    const auto found = modes.find(word);
    if (found == modes.end())
    {
        std::vector<std::string> words;
        for (const auto& [name, mode] : modes) words.push_back(name);
        throw FatalInputError(directive.data().where, "Unknown input mode '" + word + "'", "one of the modes below", words, word);
    }
    mode_ = found->second;
}

void Expansion::remove(const Tree& selection)
{
    const NodeData& data = selection.data();
    if (data.kind == NodeKind::list)
    {
        for (const auto& [key, item] : selection) remove(item);
        return;
    }
    if (data.kind != NodeKind::word && data.kind != NodeKind::string)
    {
        throw FatalInputError(data.where, "#remove is followed by " + describe(selection), "a keyword, a \"pattern\", or a list of them");
    }
    Tree& dictionary = scope_.current();
    for (auto entry = dictionary.begin(); entry != dictionary.end();)
    {
        const bool matches = entry->first == data.text || (data.kind == NodeKind::string && patternMatches(data, entry->first));
        entry = matches ? dictionary.erase(entry) : std::next(entry);
    }
}

void Expansion::include(const Tree& directive, const std::function<void(const SourceText&)>& take)
{
    const SourceLocation& where = directive.data().where;
    const std::string& directiveName = directive.data().text;
    const std::string name = withMacros(textArgumentOf(directive, "the name of a file in quotes"), where);

    std::optional<fs::path> file = directiveName == "includeEtc" ? findEtcFile(name) : includePath(name, files_.back());
    if (!file)
    {
        throw FatalInputError(where, "#includeEtc \"" + name + "\": there is no such file", "a file below $SHIZUKU_DIR/etc or ~/.shizuku");
    }
    if (!fs::is_regular_file(*file))
    {
        if (directiveName == "includeIfPresent") return;
        throw FatalInputError
        (
            where, "#" + directiveName + " \"" + name + "\": there is no file " + file->string(),
            "a file, its name relative to this one or behind <case>/, <system>/, <constant>/, <etc>/"
        );
    }
    for (const fs::path& open : files_)
    {
        std::error_code error;
        if (fs::equivalent(open, *file, error))
        {
            throw FatalInputError(where, "Circular include of " + file->string(), "a file that does not include itself in the end");
        }
    }
    take(SourceText(readText(*file), file->string()));
}

// ---- Items

void Expansion::addItem(Tree& value, const Tree& item)
{
    switch (item.data().kind)
    {
        case NodeKind::macro: addMacroItems(value, item); return;
        case NodeKind::directive: addDirectiveItems(value, item); return;
        case NodeKind::dictionary: value.push_back({"", expandedBody("", item)}); return;
        default: break;
    }
    Tree expanded(item.data());
    for (const auto& [key, child] : item) addItem(expanded, child);
    value.push_back({"", expanded});
}

void Expansion::addMacroItems(Tree& value, const Tree& macro)
{
    const Tree source = resolve(macro.data().text, macro.data().where);
    if (source.data().kind == NodeKind::dictionary) value.push_back({"", source});
    else value.insert(value.end(), source.begin(), source.end());
}

void Expansion::addDirectiveItems(Tree& value, const Tree& directive)
{
    NodeData data = directive.data();
    if (data.text == "calc" || data.text == "eval")
    {
        const std::string& expression = textArgumentOf(directive, "an expression in quotes or #{ }");
        const auto macro = [&](const std::string& name) { return number(name, data.where); };
        data.text = numberText(evaluate(expression, data.where, macro));
        data.kind = NodeKind::number;
        value.push_back({"", Tree(data)});
    }
    else if (data.text == "include" || data.text == "includeEtc")
    {
        include(directive, [&](const SourceText& source)
        {
            files_.push_back(source.name());
            for (const auto& [key, item] : parseItems(source)) addItem(value, item);
            files_.pop_back();
        });
    }
    else failDirective(directive, "as a value", {"calc", "eval", "include", "includeEtc"});
}

// ---- Macros

Tree Expansion::resolve(const std::string& name, const SourceLocation& where) const
{
    const std::size_t fallback = name.find(":-");
    const std::string key = name.substr(0, fallback);
    if (const Tree* entry = scope_.find(key)) return unused(*entry);
    if (const char* value = std::getenv(key.c_str())) return parseItems(SourceText(value, "$" + key));
    if (fallback != std::string::npos) return parseItems(SourceText(name.substr(fallback + 2), where.file));
    throw FatalInputError
    (
        where, "Undefined macro $" + key, "an entry that stands before, or a variable of the environment", scope_.visible(), key
    );
}

double Expansion::number(const std::string& macro, const SourceLocation& where) const
{
    const Tree entry = resolve(macro, where);
    ValueReader reader(entry, "one number, for $" + macro + " at line " + std::to_string(where.line) + " of " + where.file);
    reader.readDimensions();
    const double value = reader.read<double>();
    reader.finish();
    return value;
}

// A file name with $name and ${name} replaced; the bare form ends at the first character that is not of a name.
std::string Expansion::withMacros(const std::string& text, const SourceLocation& where) const
{
    std::string result;
    for (std::size_t i = 0; i < text.size();)
    {
        if (text[i] != '$') { result += text[i++]; continue; }
        const bool braced = i + 1 < text.size() && text[i + 1] == '{';
        const std::size_t begin = i + (braced ? 2 : 1);
        std::size_t end = begin;
        const auto inName = [&](char c) { return braced ? c != '}' : std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == ':'; };
        while (end < text.size() && inName(text[end])) ++end;
        ValueReader reader(resolve(text.substr(begin, end - begin), where), "one word, to be part of a file name");
        result += reader.read<std::string>();
        i = end + (braced ? 1 : 0);
    }
    return result;
}

}

std::string readText(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream || fs::is_directory(file))
    {
        throw FatalInputError({file.string(), 0}, "Cannot open file " + file.string(), "a dictionary file that can be read");
    }
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::shared_ptr<Tree> expandDictionary(const SourceText& source)
{
    auto root = std::make_shared<Tree>();
    root->data().where = {source.name(), 1};
    Expansion(*root).addFile(source);
    return root;
}

}
