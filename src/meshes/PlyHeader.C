// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/PlyHeader.H"

#include "core/messages/Error.H"

#include <map>
#include <sstream>

namespace shizuku
{

namespace
{

const std::map<std::string, PlyScalar> scalarWords
{
    {"char", PlyScalar::int8}, {"int8", PlyScalar::int8}, {"uchar", PlyScalar::uint8}, {"uint8", PlyScalar::uint8},
    {"short", PlyScalar::int16}, {"int16", PlyScalar::int16}, {"ushort", PlyScalar::uint16}, {"uint16", PlyScalar::uint16},
    {"int", PlyScalar::int32}, {"int32", PlyScalar::int32}, {"uint", PlyScalar::uint32}, {"uint32", PlyScalar::uint32},
    {"float", PlyScalar::float32}, {"float32", PlyScalar::float32}, {"double", PlyScalar::float64},
    {"float64", PlyScalar::float64}
};

class HeaderReader
{
public:
    HeaderReader(std::istream& in, const std::filesystem::path& file) : in_(in), file_(file) {}

    PlyHeader read()
    {
        if (headerLine() != "ply") fail("The first line is not 'ply'", "a PLY file");
        bool formatGiven = false;
        for (std::string text = headerLine(); text != "end_header"; text = headerLine())
        {
            std::istringstream words(text);
            std::string keyword;
            words >> keyword;
            if (keyword.empty() || keyword == "comment" || keyword == "obj_info") continue;
            if (keyword == "format")
            {
                std::string format;
                words >> format;
                if (format != "ascii" && format != "binary_little_endian" && format != "binary_big_endian")
                {
                    throw FatalInputError
                    (
                        {file_.string(), header_.lines}, "Unknown format '" + format + "'", "",
                        {"ascii", "binary_little_endian", "binary_big_endian"}, format
                    );
                }
                header_.ascii = format == "ascii";
                header_.bigEndian = format == "binary_big_endian";
                formatGiven = true;
            }
            else if (keyword == "element")
            {
                PlyElement element;
                if (!(words >> element.name >> element.count)) fail("Malformed: " + text, "element NAME COUNT");
                element.line = header_.lines;
                header_.elements.push_back(element);
            }
            else if (keyword == "property")
            {
                if (header_.elements.empty()) fail("A property before any element");
                header_.elements.back().properties.push_back(readProperty(words, text));
            }
            else
            {
                throw FatalInputError
                (
                    {file_.string(), header_.lines}, "Unknown keyword '" + keyword + "'", "",
                    {"format", "comment", "obj_info", "element", "property", "end_header"}, keyword
                );
            }
        }
        if (!formatGiven) fail("The header has no format");
        checkCounts();
        return std::move(header_);
    }

private:
    [[noreturn]] void fail(const std::string& found, const std::string& expected = "") const
    {
        throw FatalInputError({file_.string(), header_.lines}, found, expected);
    }

    std::string headerLine()
    {
        std::string text;
        if (!std::getline(in_, text)) fail("The header ends before 'end_header'");
        ++header_.lines;
        if (!text.empty() && text.back() == '\r') text.pop_back();
        return text;
    }

    // No more elements than the rest of the file has room for: a number in text takes two bytes, one in binary one at least.
    void checkCounts() const
    {
        std::error_code error;
        const auto size = std::filesystem::file_size(file_, error);
        if (error) return;
        for (const PlyElement& element : header_.elements)
        {
            const std::size_t least = (header_.ascii ? 2 : 1)*element.properties.size();
            const bool empty = least == 0 && element.count > 0;
            if (!empty && (element.count == 0 || element.count <= (size + 1)/least)) continue;
            throw FatalInputError
            (
                {file_.string(), element.line},
                "The header announces " + std::to_string(element.count) + " elements '" + element.name + "' "
                    + (empty ? "without a property" : "in a file of " + std::to_string(size) + " bytes"),
                empty ? "properties behind the element" : "a count that the file has room for"
            );
        }
    }

    PlyScalar scalarOf(const std::string& name) const
    {
        const auto found = scalarWords.find(name);
        if (found != scalarWords.end()) return found->second;
        std::vector<std::string> choices;
        for (const auto& [valid, type] : scalarWords) choices.push_back(valid);
        throw FatalInputError({file_.string(), header_.lines}, "Unknown type '" + name + "'", "", choices, name);
    }

    PlyProperty readProperty(std::istringstream& words, const std::string& text) const
    {
        PlyProperty property;
        std::string type;
        words >> type;
        if (type == "list")
        {
            std::string countType;
            words >> countType >> type;
            property.list = true;
            property.countType = scalarOf(countType);
        }
        property.type = scalarOf(type);
        if (!(words >> property.name)) fail("Malformed: " + text, "property [list COUNT_TYPE] TYPE NAME");
        return property;
    }

    std::istream& in_;
    std::filesystem::path file_;
    PlyHeader header_;
};

}

PlyHeader PlyHeader::read(std::istream& in, const std::filesystem::path& file)
{
    return HeaderReader(in, file).read();
}

}
