// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/Expansion.H"
#include "core/dictionary/DictionaryGrammar.H"
#include "core/dictionary/IncludeFile.H"
#include "core/dictionary/ValueReader.H"

#include <cctype>
#include <cstdlib>

namespace shizuku
{

namespace
{

// Entries taken over by a macro have not been looked up yet.
void forgetUse(Tree& node)
{
    node.data().used = false;
    node.data().asked.clear();
    for (auto& [key, child] : node) forgetUse(child);
}

}

Tree Expansion::resolve(const std::string& name, const SourceLocation& where)
{
    const ExpansionLimits::Nested nested(limits_, where);
    if (name.starts_with('{') && name.ends_with('}'))      // ${{ expression }}
    {
        Tree entry(NodeData{NodeKind::entry, "", KeywordStyle::word, where, {}, {}, false, {}});
        addCalculated(entry, name.substr(1, name.size() - 2), NodeData{NodeKind::number, "", KeywordStyle::word, where, {}, {}, false, {}});
        return entry;
    }
    const std::size_t fallback = name.find(":-");
    std::string key = name.substr(0, fallback);
    if (key.find('$') != std::string::npos) key = withMacros(key, where);      // ${coeffs_${model}}
    limits_.lookUp(where, key, scope_.cost());
    if (const Tree* entry = scope_.find(key, where))
    {
        limits_.copy(where, key, *entry, scope_.depth());
        Tree copy = *entry;
        forgetUse(copy);
        return copy;
    }
    if (const char* value = std::getenv(key.c_str())) return parseItems(SourceText(value, "$" + key));
    if (fallback != std::string::npos) return parseItems(SourceText(name.substr(fallback + 2), where.file));
    const bool ofAnotherFile = key.find('!', 1) != std::string::npos;          // $file!name
    throw FatalInputError
    (
        where, "Undefined macro $" + key,
        ofAnotherFile ? "an entry of this file; another file's after #include of that file"
            : "an entry that stands before, or a variable of the environment",
        scope_.visible(), key
    );
}

double Expansion::number(const std::string& macro, const SourceLocation& where)
{
    const Tree entry = resolve(macro, where);
    const std::string place = "line " + std::to_string(where.line) + " of " + where.file;
    ValueReader reader(entry, "one number, for $" + macro + " at " + place);
    reader.readDimensions();
    const double value = reader.read<double>();
    reader.finish();
    return value;
}

// A file name with $name and ${name} replaced; the bare form ends at the first character that is not of a name.
std::string Expansion::withMacros(const std::string& text, const SourceLocation& where)
{
    std::string result;
    for (std::size_t i = 0; i < text.size();)
    {
        if (text[i] != '$') { result += text[i++]; continue; }
        const bool braced = i + 1 < text.size() && text[i + 1] == '{';
        const std::size_t begin = i + (braced ? 2 : 1);
        std::size_t end = begin;
        const auto inName = [&](unsigned char c)
        {
            return braced ? c != '}' : std::isalnum(c) || c == '_' || c == ':';
        };
        while (end < text.size() && inName(text[end])) ++end;
        const std::string name = text.substr(begin, end - begin);
        if (name == "FOAM_CASE" && !std::getenv("FOAM_CASE")) result += caseFolder(files_.back()).string();
        else
        {
            const Tree source = resolve(name, where);
            ValueReader reader(source, "one word, to be part of a file name");
            result += reader.read<std::string>();
        }
        i = end + (braced ? 1 : 0);
    }
    return result;
}

std::string Expansion::keywordOf(const Tree& syntax)
{
    const NodeData& data = syntax.data();
    if (data.style != KeywordStyle::macro) return data.text;
    const Tree source = resolve(data.text, data.where);
    ValueReader reader(source, "one word, to be a keyword");
    const std::string keyword = reader.read<std::string>();
    reader.finish();
    return keyword;
}

void Expansion::addMacro(const Tree& macro)
{
    const NodeData& data = macro.data();
    const Tree source = resolve(data.text, data.where);
    if (source.data().kind != NodeKind::dictionary)
    {
        throw FatalInputError(data.where, "$" + data.text + " is no dictionary", "$dictionary; or keyword $"
            + data.text + ";");
    }
    for (const auto& [key, entry] : source) mergeEntry(scope_.current(), entry, mode_);
}

void Expansion::addMacroItems(Tree& value, const Tree& macro)
{
    const Tree source = resolve(macro.data().text, macro.data().where);
    if (source.data().kind == NodeKind::dictionary) value.push_back({"", source});
    else value.insert(value.end(), source.begin(), source.end());
}

}
