// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/dictionary/DictionaryJson.H"
#include "core/dictionary/CalcExpression.H"
#include "core/dictionary/InputLimits.H"

#include <cmath>
#include <iomanip>
#include <sstream>
#include <stdexcept>
#include <string>

namespace shizuku
{

namespace
{

std::string jsonString(const std::string& text)
{
    std::ostringstream result;
    result << '"';
    for (const char c : text)
    {
        const int code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') result << '\\' << c;
        else if (c == '\n') result << "\\n";
        else if (c == '\t') result << "\\t";
        else if (code < 0x20) result << "\\u" << std::hex << std::setw(4) << std::setfill('0') << code << std::dec;
        else result << c;
    }
    result << '"';
    return result.str();
}

// JSON knows neither "+1", ".5" nor "nan": numbers are written anew, what is not finite as a string.
std::string numberOrString(const std::string& text)
{
    try
    {
        const double value = std::stod(text);
        return std::isfinite(value) ? numberText(value) : jsonString(text);
    }
    catch (const std::out_of_range&)
    {
        return jsonString(text);
    }
}

void writeNode(std::ostream& stream, const Tree& node, int depth);

void writeArray(std::ostream& stream, const Tree& items, std::size_t repeats, int depth)
{
    const char* separator = "";
    stream << '[';
    for (std::size_t i = 0; i < repeats; ++i)
    {
        for (const auto& [key, item] : items)
        {
            stream << separator;
            writeNode(stream, item, depth);
            separator = ", ";
        }
    }
    stream << ']';
}

void writeObject(std::ostream& stream, const Tree& dictionary, int depth)
{
    const std::string indent(4*depth, ' ');
    const char* separator = "\n";
    stream << '{';
    for (const auto& [key, entry] : dictionary)
    {
        stream << separator << indent << "    " << jsonString(key) << ": ";
        writeNode(stream, entry, depth + 1);
        separator = ",\n";
    }
    if (!dictionary.empty()) stream << '\n' << indent;
    stream << '}';
}

void writeNode(std::ostream& stream, const Tree& node, int depth)
{
    const NodeData& data = node.data();
    switch (data.kind)
    {
        case NodeKind::dictionary: writeObject(stream, node, depth); break;
        case NodeKind::list: writeArray(stream, node, 1, depth); break;
        case NodeKind::uniformList: writeArray(stream, node, std::stoul(data.text), depth); break;
        case NodeKind::number: stream << numberOrString(data.text); break;
        case NodeKind::dimensions: stream << jsonString("[" + data.text + "]"); break;
        case NodeKind::entry:
            if (node.empty()) stream << "null";
            else if (node.size() == 1) writeNode(stream, node.front().second, depth);
            else writeArray(stream, node, 1, depth);
            break;
        default: stream << jsonString(data.text);
    }
}

// Values that are written, N{value} being N of them.
double valuesOf(const Tree& node)
{
    double values = node.empty() ? 1 : 0;
    for (const auto& [key, child] : node) values += valuesOf(child);
    return node.data().kind == NodeKind::uniformList ? values*std::stod(node.data().text) : values;
}

}

void writeJson(std::ostream& stream, const Tree& node)
{
    if (valuesOf(node) > inputLimits::jsonValues)
    {
        throw FatalInputError(node.data().where, "Too many values for JSON, N{value} being N of them",
            "at most " + std::to_string(inputLimits::jsonValues));
    }
    writeNode(stream, node, 0);
    stream << '\n';
}

}
