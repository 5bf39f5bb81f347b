// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/DictionaryEditor.H"
#include "core/dictionary/DictionaryGrammar.H"
#include "core/dictionary/DictionaryWriter.H"
#include "core/dictionary/EntryPath.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// Where values start, counted from the keyword, without a neighbour to follow.

std::string trimmed(const std::string& text)
{
    const char* const blanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blanks);
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

bool isBlank(const std::string& text)
{
    return trimmed(text).empty();
}

// "keyword value;" or "keyword { ... }". Throws FatalInputError unless it is exactly one such entry.
std::string entryText(const std::string& keyword, const std::string& value, std::size_t column = valueColumn)
{
    const std::string gap(keyword.size() < column ? column - keyword.size() : 1, ' ');
    const std::string text = value.starts_with('{') ? keyword + " " + value
                           : value.empty() ? keyword + ";" : keyword + gap + value + ";";
    const Tree parsed = parseSyntax(SourceText(text, "new entry"));
    const bool single = parsed.size() == 1 && parsed.front().second.data().span.end == text.size()
        && parsed.front().second.data().kind == (value.starts_with('{') ? NodeKind::dictionary : NodeKind::entry);
    if (!single)
    {
        throw FatalInputError({}, "'" + text + "' is not one entry", "one keyword, and a value without ';' or { ... }");
    }
    return text;
}

// Where the value of the last plain entry starts, so that a new one lines up with it.
std::size_t columnOfValues(const Tree& dictionary)
{
    if (dictionary.empty()) return valueColumn;
    const NodeData& last = dictionary.back().second.data();
    const bool onOneLine = last.kind == NodeKind::entry && dictionary.back().second.size() > 0
        && dictionary.back().second.front().second.data().where.line == last.where.line;
    return onOneLine ? last.value.begin - last.span.begin : valueColumn;
}

}

DictionaryEditor::DictionaryEditor(std::string text, std::string name)
:
    text_(std::move(text)), name_(std::move(name)), syntax_(parseSyntax(SourceText(text_, name_)))
{}

void DictionaryEditor::set(const std::string& path, const std::string& value)
{
    const std::vector<Tree*> entries = findEntries(syntax_, path);
    if (entries.empty()) failMissing(path, "an entry that is there, or -add in place of -set to make this one");
    const NodeData& data = entries.back()->data();
    const std::string text = trimmed(value);
    entryText(splitPath(path).keyword, text);

    const bool wasDictionary = data.kind == NodeKind::dictionary;
    const bool isDictionary = text.starts_with('{');
    if (wasDictionary)
    {
        replace({data.value.begin - 1, data.span.end}, isDictionary ? text : text + ";");
    }
    else if (isDictionary)
    {
        replace({data.value.begin, data.span.end}, (data.value.begin == data.value.end ? " " : "") + text);
    }
    else
    {
        const bool hadNone = data.value.begin == data.value.end;
        replace(data.value, hadNone && !text.empty() ? " " + text : text);
    }
}

void DictionaryEditor::add(const std::string& path, const std::string& value)
{
    if (const auto there = findEntries(syntax_, path); !there.empty())
    {
        throw FatalInputError(there.back()->data().where, "Entry '" + path + "' is there already",
            "a new keyword, or -set");
    }
    const SplitPath split = splitPath(path);
    const Tree* dictionary = &syntax_;
    if (!split.dictionary.empty())
    {
        const std::vector<Tree*> found = findEntries(syntax_, split.dictionary);
        if (found.empty()) failMissing(split.dictionary);
        dictionary = found.back();
        if (dictionary->data().kind != NodeKind::dictionary)
        {
            throw FatalInputError(dictionary->data().where, "Entry '" + split.dictionary + "' is no dictionary",
                "the path of a dictionary");
        }
    }
    insert(*dictionary, entryText(split.keyword, trimmed(value), columnOfValues(*dictionary)));
}

void DictionaryEditor::remove(const std::string& path)
{
    std::vector<Tree*> entries = findEntries(syntax_, path);
    if (entries.empty()) failMissing(path);
    std::vector<TextSpan> spans;
    for (const Tree* entry : entries) spans.push_back(entry->data().span);
    std::sort(spans.begin(), spans.end(), [](const TextSpan& a, const TextSpan& b) { return a.begin > b.begin; });
    for (const TextSpan& span : spans) removeSpan(span);
}

void DictionaryEditor::replace(TextSpan span, const std::string& replacement)
{
    text_.replace(span.begin, span.end - span.begin, replacement);
    syntax_ = parseSyntax(SourceText(text_, name_));
}

void DictionaryEditor::insert(const Tree& dictionary, const std::string& entry)
{
    const bool isRoot = &dictionary == &syntax_;
    const NodeData& data = dictionary.data();
    const std::size_t bodyEnd = isRoot ? text_.size() : data.value.end;
    std::size_t at = isRoot ? 0 : data.value.begin;
    const std::size_t owner = isRoot ? 0 : data.span.begin;
    std::size_t aligned = owner;                // a statement with the right indentation
    std::string deeper = isRoot ? "" : "    ";
    if (!dictionary.empty())
    {
        at = dictionary.back().second.data().span.end;
        aligned = dictionary.back().second.data().span.begin;
        deeper.clear();
    }
    else if (isRoot) at = bodyEnd;

    const std::size_t lineEnd = text_.find('\n', at);
    if (lineEnd >= bodyEnd && !isRoot)                                  // { a 1; } on one line
    {
        const bool padded = at < bodyEnd && text_[bodyEnd - 1] == ' ';
        replace({at, at}, " " + entry + (padded ? "" : " "));
        return;
    }

    const std::size_t lineBegin = aligned == 0 ? 0 : text_.rfind('\n', aligned - 1) + 1;
    const std::string before = text_.substr(lineBegin, aligned - lineBegin);
    const std::string indent = (isBlank(before) ? before : "") + deeper;
    const std::string rest = text_.substr(at, std::min(lineEnd, bodyEnd) - at);
    const bool commentGoesOn = rest.find("/*") != std::string::npos && rest.find("*/") == std::string::npos;
    if (!commentGoesOn) at = std::min(lineEnd, bodyEnd);                // behind a comment on the same line
    const bool startsLine = at == 0 || text_[at - 1] == '\n';
    const bool endsText = at == text_.size();
    replace({at, at}, (startsLine ? "" : "\n") + indent + entry + (endsText ? "\n" : ""));
}

void DictionaryEditor::removeSpan(TextSpan span)
{
    const std::size_t lineBegin = span.begin == 0 ? 0 : text_.rfind('\n', span.begin - 1) + 1;
    const std::size_t lineEnd = std::min(text_.find('\n', span.end), text_.size());
    const bool aloneBefore = isBlank(text_.substr(lineBegin, span.begin - lineBegin));
    const bool aloneBehind = isBlank(text_.substr(span.end, lineEnd - span.end));
    if (aloneBefore && aloneBehind)
    {
        span = {lineBegin, std::min(lineEnd + 1, text_.size())};
    }
    else if (!aloneBefore)
    {
        while (text_[span.begin - 1] == ' ' || text_[span.begin - 1] == '\t') --span.begin;
    }
    replace(span, "");
}

std::vector<std::string> DictionaryEditor::keywordsBeside(const std::string& path) const
{
    const SplitPath split = splitPath(path);
    Tree syntax = syntax_;
    std::vector<std::string> keywords;
    for (const Tree* dictionary : split.dictionary.empty() ? std::vector<Tree*>{&syntax} : findEntries(syntax, split.dictionary))
    {
        for (const auto& [key, entry] : *dictionary)
        {
            if (!key.empty()) keywords.push_back(key);
        }
    }
    return keywords;
}

void DictionaryEditor::failMissing(const std::string& path, const std::string& expected) const
{
    const SplitPath split = splitPath(path);
    Tree syntax = syntax_;
    const std::vector<Tree*> around =
        split.dictionary.empty() ? std::vector<Tree*>{&syntax} : findEntries(syntax, split.dictionary);
    const SourceLocation where = around.empty() ? SourceLocation{name_, 0} : around.back()->data().where;
    throw FatalInputError(where, "Entry '" + path + "' is not written in " + name_, expected,
        keywordsBeside(path), split.keyword);
}

}
