#include "core/fieldFile/FieldFile.H"

#include "core/dictionary/Dictionary.H"
#include "core/fieldFile/FieldCursor.H"
#include "core/fieldFile/FieldListReader.H"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>

namespace shizuku
{

namespace
{

std::string readFile(const std::filesystem::path& file)
{
    const SourceLocation where{file.string(), 0};
    if (!std::filesystem::exists(file)) throw FatalInputError(where, "The field file is missing");
    if (!std::filesystem::is_regular_file(file)) throw FatalInputError(where, "This is not a file", "a field file");
    std::ifstream stream(file, std::ios::binary);
    std::string text(std::filesystem::file_size(file), '\0');
    if (!stream.read(text.data(), static_cast<std::streamsize>(text.size())))
    {
        throw FatalInputError(where, std::string("The field file cannot be read: ") + std::strerror(errno));
    }
    return text;
}

// The text in two: what the dictionary reads, and where the values stand.
struct FieldText
{
    std::string dictionary;         // all of a uniform field; what stands before internalField else
    bool uniform = false;
    std::size_t listStart = 0;      // behind "nonuniform"
};

FieldText splitText(const std::string& file, const std::string& text)
{
    FieldCursor cursor(file, text);
    while (!cursor.atEnd())
    {
        const std::size_t start = cursor.position();
        if (*cursor.data() == '#')
        {
            cursor.skipLine();
            continue;
        }
        const std::string keyword = cursor.word();
        if (keyword != "internalField")
        {
            cursor.skipEntry();
            continue;
        }

        FieldText result;
        cursor.skipBlanks();
        const std::size_t kindStart = cursor.position();
        const std::string kind = cursor.word();
        if (kind == "uniform")
        {
            result.uniform = true;
            result.dictionary = text;
            result.dictionary.replace(kindStart, kind.size(), kind.size(), ' ');
        }
        else if (kind == "nonuniform")
        {
            result.dictionary = text.substr(0, start);
            result.listStart = cursor.position();
        }
        else
        {
            FieldCursor(file, text, kindStart).fail("uniform or nonuniform behind internalField");
        }
        return result;
    }
    throw FatalInputError({file, 0}, "The keyword internalField is missing", "internalField uniform|nonuniform ...;");
}

// "LSB;label=32;scalar=32" of the header of a binary file.
BinaryLayout readLayout(const Dictionary& header)
{
    const std::string arch = header.lookup<std::string>("arch");
    const auto bytes = [&](const std::string& kind)
    {
        if (arch.find(kind + "=32") != std::string::npos) return 4;
        if (arch.find(kind + "=64") != std::string::npos) return 8;
        return 0;
    };
    const BinaryLayout layout{bytes("label"), bytes("scalar")};
    if (!arch.starts_with("LSB") || layout.labelBytes == 0 || layout.scalarBytes == 0)
    {
        throw FatalInputError
        (
            header.where("arch"), "The binary layout is \"" + arch + "\"", "\"LSB;label=32|64;scalar=32|64\""
        );
    }
    return layout;
}

std::vector<double> readUniform(const Dictionary& dict, FieldType type)
{
    const std::string key = "internalField";
    std::vector<double> values;
    if (type == FieldType::label) values = {static_cast<double>(dict.lookup<long>(key))};
    else if (type == FieldType::scalar) values = {dict.lookup<double>(key)};
    else
    {
        const auto vector = dict.lookup<std::array<double, 3>>(key);
        values.assign(vector.begin(), vector.end());
    }
    for (const double value : values)
    {
        if (!std::isfinite(value))
        {
            throw FatalInputError(dict.where(key), "The uniform value is NaN or infinite", "finite numbers");
        }
    }
    return values;
}

std::vector<double> readList
(
    const std::string& file, const std::string& text, const FieldText& parts, const Dictionary& header,
    FieldType type, long expectedElements
)
{
    const bool binary = header.lookupChoiceOr("format", {"ascii", "binary"}, "ascii") == "binary";
    FieldCursor cursor(file, text, parts.listStart);
    const std::string list = "List<" + typeName(type) + ">";
    cursor.skipBlanks();
    const SourceLocation where = cursor.where();
    const std::string found = cursor.word();
    if (found != list) throw FatalInputError(where, "Found '" + found + "'", list + " behind nonuniform");

    auto values = binary
        ? readBinaryList(cursor, type, readLayout(header), expectedElements)
        : readAsciiList(cursor, type, expectedElements);
    cursor.expect(';', "behind the list");
    if (!cursor.atEnd()) cursor.fail("the end of the file");
    return values;
}

// The type that the header's class says; one of the known ones, or `expected` where that is given.
FieldType readType(const Dictionary& header, std::optional<FieldType> expected)
{
    std::vector<FieldType> types{FieldType::label, FieldType::scalar, FieldType::vector};
    if (expected) types = {*expected};
    std::vector<std::string> words;
    for (const FieldType type : types) words.push_back(typeName(type) + "Field");
    const std::string word = header.lookupChoice("class", words);
    return types[std::find(words.begin(), words.end(), word) - words.begin()];
}

// type, dimensions: what they have to be, where that is known.
FieldData readFieldOf
(
    const std::filesystem::path& file, std::optional<FieldType> type, std::optional<Dimensions> dimensions,
    long expectedElements
)
{
    const std::string name = file.string();
    const std::string text = readFile(file);
    const FieldText parts = splitText(name, text);
    const Dictionary dict = Dictionary::parse(parts.dictionary, name);
    const Dictionary header = dict.subDict("FoamFile");

    const FieldType found = readType(header, type);
    FieldData field{file.filename().string(), found, dict.lookupDimensions("dimensions"), parts.uniform, {}};
    if (dimensions && field.dimensions != *dimensions)
    {
        throw FatalInputError
        (
            dict.where("dimensions"), "The field's dimensions are " + field.dimensions.str(), dimensions->str()
        );
    }
    field.values = parts.uniform
        ? readUniform(dict, field.type)
        : readList(name, text, parts, header, field.type, expectedElements);
    dict.refuseUnused();
    return field;
}

}

std::string typeName(FieldType type)
{
    switch (type)
    {
        case FieldType::label: return "label";
        case FieldType::scalar: return "scalar";
        case FieldType::vector: break;
    }
    return "vector";
}

int componentsOf(FieldType type)
{
    return type == FieldType::vector ? 3 : 1;
}

FieldData readField(const std::filesystem::path& file, long expectedElements)
{
    return readFieldOf(file, std::nullopt, std::nullopt, expectedElements);
}

FieldData readField
(
    const std::filesystem::path& file, FieldType type, const Dimensions& dimensions, long expectedElements
)
{
    return readFieldOf(file, type, dimensions, expectedElements);
}

}
