// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/DictionaryWriter.H"

#include <algorithm>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr std::size_t itemsPerLine = 10;    // longer lists stand one item a line

std::string indentation(int depth)
{
    return std::string(4*depth, ' ');
}

bool isNested(const Tree& item)
{
    return item.data().kind == NodeKind::list || item.data().kind == NodeKind::uniformList
        || item.data().kind == NodeKind::dictionary;
}

// Short, and no deeper than a list of vectors with few elements.
bool fitsOnOneLine(const Tree& list)
{
    const auto nested = std::count_if(list.begin(), list.end(), [](const auto& item) { return isNested(item.second); });
    return list.size() <= itemsPerLine && nested == 0;
}

void writeItem(std::ostream& stream, const Tree& item, int depth);

void writeItems(std::ostream& stream, const Tree& items, int depth)
{
    const char* separator = "";
    for (const auto& [key, item] : items)
    {
        stream << separator;
        writeItem(stream, item, depth);
        separator = " ";
    }
}

void writeList(std::ostream& stream, const Tree& list, int depth)
{
    const bool uniform = list.data().kind == NodeKind::uniformList;
    stream << list.data().text << (uniform ? '{' : '(');
    if (fitsOnOneLine(list)) writeItems(stream, list, depth);
    else
    {
        for (const auto& [key, item] : list)
        {
            stream << '\n' << indentation(depth + 1);
            writeItem(stream, item, depth + 1);
        }
        stream << '\n' << indentation(depth);
    }
    stream << (uniform ? '}' : ')');
}

void writeItem(std::ostream& stream, const Tree& item, int depth)
{
    const NodeData& data = item.data();
    switch (data.kind)
    {
        case NodeKind::string: stream << quotedText(data.text); break;
        case NodeKind::verbatim: stream << "#{" << data.text << "#}"; break;
        case NodeKind::dimensions: stream << '[' << data.text << ']'; break;
        case NodeKind::list:
        case NodeKind::uniformList: writeList(stream, item, depth); break;
        case NodeKind::dictionary:
            stream << "{\n";
            writeEntries(stream, item, depth + 1);
            stream << indentation(depth) << '}';
            break;
        default: stream << data.text;
    }
}

}

std::string quotedText(const std::string& text)
{
    std::string result = "\"";
    for (const char c : text)
    {
        if (c == '"') result += '\\';
        result += c;
    }
    return result + '"';
}

void writeEntry(std::ostream& stream, const Tree& entry, int depth)
{
    const NodeData& data = entry.data();
    const std::string keyword = data.style == KeywordStyle::pattern ? quotedText(data.text) : data.text;
    stream << indentation(depth) << keyword;
    if (data.kind == NodeKind::dictionary)
    {
        stream << '\n' << indentation(depth);
        writeItem(stream, entry, depth);
        stream << '\n';
        return;
    }
    if (!entry.empty())
    {
        stream << std::string(keyword.size() < valueColumn ? valueColumn - keyword.size() : 1, ' ');
        writeItems(stream, entry, depth);
    }
    stream << ";\n";
}

void writeEntries(std::ostream& stream, const Tree& dictionary, int depth)
{
    for (const auto& [key, entry] : dictionary) writeEntry(stream, entry, depth);
}

void writeValue(std::ostream& stream, const Tree& entry)
{
    if (entry.data().kind == NodeKind::dictionary) writeEntries(stream, entry);
    else
    {
        writeItems(stream, entry, 0);
        stream << '\n';
    }
}

std::string valueText(const Tree& entry)
{
    std::ostringstream stream;
    writeValue(stream, entry);
    std::string text = stream.str();
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
}

}
