// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/Expansion.H"
#include "core/dictionary/CalcExpression.H"
#include "core/dictionary/DictionaryExpansion.H"
#include "core/dictionary/DictionaryGrammar.H"
#include "core/dictionary/IncludeFile.H"
#include "core/dictionary/ValueReader.H"
#include "core/paths/Existence.H"

#include <cstdlib>
#include <map>
#include <optional>

namespace shizuku
{

namespace
{

namespace fs = std::filesystem;

const Tree& argumentOf(const Tree& directive)
{
    if (directive.empty())
    {
        throw FatalInputError(directive.data().where, "#" + directive.data().text + " stands alone",
            "something behind it");
    }
    return directive.front().second;
}

const std::string& textArgumentOf(const Tree& directive, const char* expected)
{
    const NodeData& data = argumentOf(directive).data();
    if (data.kind != NodeKind::string && data.kind != NodeKind::word && data.kind != NodeKind::verbatim)
    {
        throw FatalInputError(data.where, "#" + directive.data().text + " is followed by "
            + describe(argumentOf(directive)), expected);
    }
    return data.text;
}

double numberOf(const Tree& token)
{
    return std::strtod(token.data().text.c_str(), nullptr);
}

[[noreturn]] void failDirective(const Tree& directive, const std::string& place,
    const std::vector<std::string>& choices)
{
    const NodeData& data = directive.data();
    // What OpenFOAM has for it, and what to write instead.
    static const std::map<std::string, std::pair<std::string, std::string>> foreign
    {
        {"codeStream", {"compiler run", "a value, or #calc"}},
        {"includeFunc", {"function files", "the function written out: name { type ...; }"}},
        {"includeConstraint", {"files of constraints", "the dictionary written out: name { type ...; }"}},
        {"includeModel", {"files of models", "the dictionary written out: name { type ...; }"}}
    };
    if (const auto found = foreign.find(data.text); found != foreign.end())
    {
        throw FatalInputError(data.where, "#" + data.text + " needs OpenFOAM's own " + found->second.first,
            found->second.second);
    }
    throw FatalInputError(data.where, "#" + data.text + " is unknown " + place, "one of the directives below",
        choices, data.text);
}

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
        {"sinclude", addIncluded},
        {"inputMode", [](Expansion& expansion, const Tree& argument) { expansion.setInputMode(argument); }},
        {"remove", [](Expansion& expansion, const Tree& argument) { expansion.remove(argumentOf(argument)); }}
    };
    const auto action = actions.find(directive.data().text);
    if (action == actions.end())
    {
        failDirective(directive, "as a statement",
            {"include", "includeEtc", "includeIfPresent", "sinclude", "inputMode", "remove"});
    }
    action->second(*this, directive);
}

// The one word, string or number that an operand of #if or #ifeq stands for.
Tree Expansion::operandOf(const Tree& conditional, const Tree& item)
{
    Tree operand;
    addItem(operand, item);
    const auto isPlain = [](NodeKind kind)
    {
        return kind == NodeKind::word || kind == NodeKind::string || kind == NodeKind::number;
    };
    if (operand.size() != 1 || !isPlain(operand.front().second.data().kind))
    {
        const std::string found = operand.empty() ? "nothing" : describe(operand.front().second);
        throw FatalInputError(conditional.data().where, "#" + conditional.data().text + " is followed by " + found,
            "one word, string or number for each side");
    }
    Tree value(operand.front().second.data());
    if (value.data().kind == NodeKind::string) value.data().text = withMacros(value.data().text, item.data().where);
    return value;
}

bool Expansion::holds(const Tree& conditional)
{
    const bool bracketed = conditional.size() == 1 && conditional.front().second.data().kind == NodeKind::list;
    const Tree& sides = bracketed ? conditional.front().second : conditional;
    const std::size_t expected = conditional.data().text == "ifeq" ? 2 : 1;
    if (sides.size() != expected)
    {
        throw FatalInputError(conditional.data().where, "#" + conditional.data().text + " is followed by "
            + std::to_string(sides.size()) + " values", std::to_string(expected));
    }
    std::vector<Tree> operands;
    for (const auto& [key, item] : sides) operands.push_back(operandOf(conditional, item));
    const auto isNumber = [](const Tree& operand) { return operand.data().kind == NodeKind::number; };

    const Tree& first = operands.front();
    if (conditional.data().text == "ifeq")
    {
        const Tree& second = operands.back();
        if (isNumber(first) && isNumber(second)) return numberOf(first) == numberOf(second);
        return first.data().text == second.data().text;
    }
    if (isNumber(first)) return numberOf(first) != 0;
    Tree entry;
    entry.push_back({"", first});
    entry.data().kind = NodeKind::entry;
    entry.data().where = conditional.data().where;
    ValueReader reader(entry, "a switch or a number, for #if");
    return reader.read<bool>();
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
        throw FatalInputError(directive.data().where, "Unknown input mode '" + word + "'", "one of the modes below",
            words, word);
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
        throw FatalInputError(data.where, "#remove is followed by " + describe(selection),
            "a keyword, a \"pattern\", or a list of them");
    }
    Tree& dictionary = scope_.current();
    for (auto entry = dictionary.begin(); entry != dictionary.end();)
    {
        const bool matches = entry->first == data.text
            || (data.kind == NodeKind::string && patternMatches(data, entry->first));
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
        std::string folders;
        for (const fs::path& folder : etcFolders()) folders += (folders.empty() ? "" : ", ") + folder.string();
        throw FatalInputError(where, "#includeEtc \"" + name + "\": there is no such file",
            "a file below one of " + folders);
    }
    if (!isFile(*file))
    {
        if (directiveName == "includeIfPresent" || directiveName == "sinclude") return;
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
            throw FatalInputError(where, "Circular include of " + file->string(),
                "a file that does not include itself in the end");
        }
    }
    limits_.include(where, files_.size());
    take(SourceText(readText(*file), file->string()));
}

void Expansion::addCalculated(Tree& value, const std::string& expression, NodeData data)
{
    const auto macro = [&](const std::string& name) { return number(name, data.where); };
    data.text = numberText(CalcExpression(expression, data.where, macro)());
    data.kind = NodeKind::number;
    value.push_back({"", Tree(data)});
}

void Expansion::addDirectiveItems(Tree& value, const Tree& directive)
{
    const NodeData& data = directive.data();
    if (data.text == "calc" || data.text == "eval")
    {
        const std::string& expression = textArgumentOf(directive, "an expression in quotes or #{ }");
        addCalculated(value, expression, data);
    }
    else if (data.text == "include" || data.text == "includeEtc")
    {
        include(directive, [&](const SourceText& source)
        {
            limits_.read(data.where, source.text().size());
            files_.push_back(source.name());
            for (const auto& [key, item] : parseItems(source)) addItem(value, item);
            files_.pop_back();
        });
    }
    else failDirective(directive, "as a value", {"calc", "eval", "include", "includeEtc"});
}

}
