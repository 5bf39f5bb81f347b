// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/AtomicFile.H"
#include "core/fieldFile/FieldFile.H"
#include "core/fieldFile/FileBuffer.H"
#include "core/fieldFile/FoamFileHeader.H"
#include "core/messages/Error.H"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr std::size_t portion = 1 << 14;        // elements

bool canBeRead(double value, FieldType type, const WriteFormat& format)
{
    const bool single = format.binary && format.scalarBits == 32;
    if (type != FieldType::label) return std::isfinite(single ? static_cast<float>(value) : value);
    return std::abs(value) <= std::numeric_limits<std::int32_t>::max() && value == std::trunc(value);
}

// What could not be read back is not written. first: the element that the values begin with.
void checkValues
(
    const std::filesystem::path& file, FieldType type, std::size_t first, std::span<const double> values,
    const WriteFormat& format
)
{
    const auto bad = std::find_if(values.begin(), values.end(), [&](double v) { return !canBeRead(v, type, format); });
    if (bad == values.end()) return;
    throw FatalError
    (
        "Cannot write " + file.string() + ": the value " + std::to_string(*bad) + " of element "
      + std::to_string(first + (bad - values.begin()) / componentsOf(type)) + " is not a "
      + (type == FieldType::label ? "32-bit label" : "finite number")
    );
}

void appendNumber(std::string& text, double value, FieldType type, int precision)
{
    char digits[64];
    const auto result = type == FieldType::label
        ? std::to_chars(digits, digits + sizeof digits, static_cast<long>(value))
        : std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, precision);
    text.append(digits, result.ptr);
}

void appendElement(std::string& text, const double* values, FieldType type, int precision)
{
    if (type != FieldType::vector)
    {
        appendNumber(text, values[0], type, precision);
        return;
    }
    text += '(';
    for (int component = 0; component < 3; ++component)
    {
        if (component > 0) text += ' ';
        appendNumber(text, values[component], type, precision);
    }
    text += ')';
}

std::string textOf(FieldType type, std::span<const double> values, int precision)
{
    std::string text;
    for (std::size_t i = 0; i < values.size(); i += componentsOf(type))
    {
        appendElement(text, values.data() + i, type, precision);
        text += '\n';
    }
    return text;
}

template<class T>
void writeBinary(std::ostream& stream, std::span<const double> values)
{
    const std::vector<T> raw(values.begin(), values.end());
    stream.write(reinterpret_cast<const char*>(raw.data()), static_cast<std::streamsize>(raw.size() * sizeof(T)));
}

// Asks for all values, in portions. take(first element, values)
template<class Take>
void forPortions(const FieldSource& source, const Take& take)
{
    std::vector<double> buffer(std::min(portion, source.elements) * componentsOf(source.type));
    for (std::size_t first = 0; first < source.elements; first += portion)
    {
        const std::span<double> values(buffer.data(), std::min(portion, source.elements - first) * componentsOf(source.type));
        source.fill(first, values);
        take(first, values);
    }
}

// before: elements of other shares, for messages.
void writeElements(std::ostream& stream, const std::filesystem::path& file, const FieldSource& source, std::size_t before, const WriteFormat& format)
{
    forPortions(source, [&](std::size_t first, std::span<const double> values)
    {
        checkValues(file, source.type, before + first, values, format);
        if (!format.binary) stream << textOf(source.type, values, format.precision);
        else if (source.type == FieldType::label) writeBinary<std::int32_t>(stream, values);
        else if (format.scalarBits == 64) writeBinary<double>(stream, values);
        else writeBinary<float>(stream, values);
    });
}

// What the header says of the field besides its type.
std::string metaOf(double spacing)
{
    if (spacing == 0) return "";
    std::string text = "spacing ";
    appendNumber(text, spacing, FieldType::scalar, 9);
    return text + ";";
}

// Up to what stands behind internalField.
void writeHead(std::ostream& stream, const std::filesystem::path& file, FieldType type, const Dimensions& dimensions, double spacing, const WriteFormat& format)
{
    const std::string arch = "LSB;label=32;scalar=" + std::to_string(format.scalarBits);
    writeFoamFileHeader(stream, file, typeName(type) + "Field", format.binary ? arch : "", metaOf(spacing));
    stream << "dimensions      " << dimensions.str() << ";\n\ninternalField   ";
}

// Up to the first one of so many elements, and what stands behind the last.
void beginList(std::ostream& stream, const std::filesystem::path& file, const FieldSource& source, std::size_t elements, const WriteFormat& format)
{
    writeHead(stream, file, source.type, source.dimensions, source.spacing, format);
    stream << "nonuniform List<" << typeName(source.type) << "> " << elements << (format.binary ? "(" : "\n(\n");
}

void endList(std::ostream& stream) { stream << ");\n"; }

void writeUniform(const std::filesystem::path& file, const FieldData& field, const WriteFormat& format)
{
    if (field.elements() != 1) throw FatalError("Cannot write " + file.string() + ": a uniform field has one element");
    checkValues(file, field.type, 0, field.values, format);
    writeAtomically(file, [&](std::ostream& stream)
    {
        std::string value;
        appendElement(value, field.values.data(), field.type, format.precision);
        writeHead(stream, file, field.type, field.dimensions, field.spacing, format);
        stream << "uniform " << value << ";\n";
    });
}

}

void writeField(const std::filesystem::path& file, const FieldSource& source, const WriteFormat& format)
{
    writeAtomically(file, [&](std::ostream& stream)
    {
        beginList(stream, file, source, source.elements, format);
        writeElements(stream, file, source, 0, format);
        endList(stream);
    });
}

void writeShare(const std::filesystem::path& file, const SharedField& share, std::uint64_t before, const WriteFormat& format)
{
    std::ostringstream head;
    beginList(head, file, share.own, share.elements, format);
    const bool isFirst = share.first == 0, isLast = share.first + share.own.elements == share.elements;
    FileBuffer buffer(file, isFirst ? 0 : head.str().size() + before);
    const auto refuse = [&](const std::string& reason) { throw FatalError("Cannot write " + file.string() + ": " + reason); };
    if (!buffer.failure().empty()) refuse(buffer.failure());
    std::ostream stream(&buffer);
    if (isFirst) stream << head.str();
    writeElements(stream, file, share.own, share.first, format);
    if (isLast) endList(stream);
    if (!buffer.close()) refuse(buffer.failure());
    if (!stream) refuse("the output stream failed");
}

std::uint64_t bytesOf(const SharedField& share, const WriteFormat& format)
{
    const FieldSource& own = share.own;
    const std::uint64_t each = own.type != FieldType::label && format.scalarBits == 64 ? sizeof(double) : sizeof(float);
    if (format.binary) return own.elements * componentsOf(own.type) * each;
    std::uint64_t bytes = 0;
    forPortions(own, [&](std::size_t, std::span<const double> values) { bytes += textOf(own.type, values, format.precision).size(); });
    return bytes;
}

void writeField(const std::filesystem::path& file, const FieldData& field, const WriteFormat& format)
{
    if (field.uniform) return writeUniform(file, field, format);
    const auto fill = [&](std::size_t first, std::span<double> values)
    {
        std::copy_n(field.values.begin() + first * componentsOf(field.type), values.size(), values.begin());
    };
    writeField(file, {field.type, field.dimensions, field.elements(), fill, field.spacing}, format);
}

}
