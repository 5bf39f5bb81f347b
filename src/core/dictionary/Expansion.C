// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/Expansion.H"
#include "core/dictionary/Conditionals.H"
#include "core/dictionary/DictionaryGrammar.H"

namespace shizuku
{

void Expansion::addFile(const SourceText& source)
{
    limits_.read({source.name(), 0}, source.text().size());
    files_.push_back(source.name());
    addStatements(parseSyntax(source));
    files_.pop_back();
}

void Expansion::addStatements(const Tree& syntax)
{
    Conditionals conditionals;
    for (const auto& [key, statement] : syntax)
    {
        if (Conditionals::isConditional(statement))
        {
            conditionals.step(statement, [&, &directive = statement] { return holds(directive); });
        }
        if (!conditionals.active() || Conditionals::isConditional(statement)) continue;
        const bool header = key == "FoamFile" && files_.size() > 1;     // of an included file
        switch (statement.data().kind)
        {
            case NodeKind::macro: addMacro(statement); break;
            case NodeKind::directive: addDirective(statement); break;
            default: if (!header) addEntry(statement);
        }
    }
    conditionals.requireClosed();
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

}
