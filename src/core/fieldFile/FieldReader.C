// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/FieldReader.H"

#include "core/dictionary/Dictionary.H"
#include "core/fieldFile/FieldCursor.H"

#include <algorithm>

namespace shizuku
{

namespace
{

constexpr std::size_t atOnce = 1 << 14;        // elements

// The text in two: what the dictionary reads, and where the values stand.
struct FieldText
{
    std::string dictionary;         // all of a uniform field; what stands before internalField else
    bool uniform = false;
    std::size_t listStart = 0;      // behind "nonuniform"
};

FieldText splitText(const std::string& file, std::string_view text)
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
    if (type == FieldType::label) return {static_cast<double>(dict.lookup<long>(key))};
    if (type == FieldType::scalar) return {dict.lookup<double>(key)};
    const auto vector = dict.lookup<std::array<double, 3>>(key);
    return {vector.begin(), vector.end()};
}

// "List<vector>" of a field of vectors.
void expectListOf(FieldType type, FieldCursor& cursor)
{
    const std::string list = "List<" + typeName(type) + ">";
    cursor.skipBlanks();
    const SourceLocation where = cursor.where();
    const std::string found = cursor.word();
    if (found != list) throw FatalInputError(where, "Found '" + found + "'", list + " behind nonuniform");
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

}

FieldReader::FieldReader
(
    const std::filesystem::path& file, std::optional<FieldType> type, std::optional<Dimensions> dimensions,
    long expectedElements
)
    : name_(file.string()), file_(file)
{
    const FieldText parts = splitText(name_, file_.text());
    const Dictionary dict = Dictionary::parse(parts.dictionary, name_);
    const Dictionary header = dict.subDict("FoamFile");
    type_ = readType(header, type);
    spacing_ = header.subDictOrEmpty("meta").lookupOr("spacing", 0.0);
    dimensions_ = dict.lookupDimensions("dimensions");
    if (dimensions && dimensions_ != *dimensions)
    {
        throw FatalInputError
        (
            dict.where("dimensions"), "The field's dimensions are " + dimensions_.str(), dimensions->str()
        );
    }

    uniform_ = parts.uniform;
    if (uniform_) values_ = readUniform(dict, type_);
    else
    {
        const bool binary = header.lookupChoiceOr("format", {"ascii", "binary"}, "ascii") == "binary";
        FieldCursor cursor(name_, file_.text(), parts.listStart);
        expectListOf(type_, cursor);
        if (binary) binary_.emplace(cursor, type_, readLayout(header), expectedElements);
        else values_ = readAsciiList(cursor, type_, expectedElements);
        cursor.expect(';', "behind the list");
        if (!cursor.atEnd()) cursor.fail("the end of the file");
    }
    dict.refuseUnused();
}

std::size_t FieldReader::elements() const
{
    return binary_ ? binary_->elements() : values_.size() / componentsOf(type_);
}

void FieldReader::read(const ElementRange& range, const Take& take) const
{
    const std::size_t components = componentsOf(type_);
    std::vector<double> values(std::min(atOnce, range.end - range.first) * components);
    if (uniform_)
    {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = values_[i % components];
    }
    for (std::size_t first = range.first; first < range.end; first += atOnce)
    {
        const std::size_t count = std::min(atOnce, range.end - first) * components;
        if (binary_) binary_->read(first, {values.data(), count});
        const double* const there = binary_ || uniform_ ? values.data() : values_.data() + first * components;
        take(first, {there, count});
    }
}

}
