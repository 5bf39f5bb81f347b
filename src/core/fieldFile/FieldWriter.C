#include "core/fieldFile/AtomicFile.H"
#include "core/fieldFile/FieldFile.H"
#include "core/fieldFile/FoamFileHeader.H"
#include "core/messages/Error.H"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace shizuku
{

namespace
{

constexpr std::size_t chunkBytes = 1 << 20;

// What could not be read back is not written.
void checkValues(const std::filesystem::path& file, const FieldData& field, bool binary)
{
    const bool label = field.type == FieldType::label;
    const std::size_t components = componentsOf(field.type);
    for (std::size_t i = 0; i < field.values.size(); ++i)
    {
        const double value = field.values[i];
        const bool valid = label
            ? std::abs(value) <= std::numeric_limits<std::int32_t>::max() && value == std::trunc(value)
            : std::isfinite(binary ? static_cast<float>(value) : value);
        if (valid) continue;
        throw FatalError
        (
            "Cannot write " + file.string() + ": the value " + std::to_string(value) + " of element "
          + std::to_string(i / components) + " is not a " + (label ? "32-bit label" : "finite number")
        );
    }
    if (field.uniform && field.values.size() != components)
    {
        throw FatalError("Cannot write " + file.string() + ": a uniform field has one element");
    }
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

void writeAsciiList(std::ostream& stream, const FieldData& field, int precision)
{
    const std::size_t components = componentsOf(field.type);
    std::string text = "\n(\n";
    text.reserve(chunkBytes + 256);
    for (std::size_t i = 0; i < field.values.size(); i += components)
    {
        appendElement(text, field.values.data() + i, field.type, precision);
        text += '\n';
        if (text.size() < chunkBytes) continue;
        stream.write(text.data(), static_cast<std::streamsize>(text.size()));
        text.clear();
    }
    stream << text << ")";
}

template<class T>
void writeBinaryList(std::ostream& stream, const std::vector<double>& values)
{
    const std::vector<T> raw(values.begin(), values.end());
    stream << "(";
    stream.write(reinterpret_cast<const char*>(raw.data()), static_cast<std::streamsize>(raw.size() * sizeof(T)));
    stream << ")";
}

}

void writeField(const std::filesystem::path& file, const FieldData& field, const WriteFormat& format)
{
    checkValues(file, field, format.binary);
    const std::string type = typeName(field.type);
    writeAtomically(file, [&](std::ostream& stream)
    {
        writeFoamFileHeader(stream, file, type + "Field", format.binary ? "LSB;label=32;scalar=32" : "");
        stream << "dimensions      " << field.dimensions.str() << ";\n\ninternalField   ";
        if (field.uniform)
        {
            std::string value;
            appendElement(value, field.values.data(), field.type, format.precision);
            stream << "uniform " << value << ";\n";
            return;
        }
        stream << "nonuniform List<" << type << "> " << field.elements();
        if (!format.binary) writeAsciiList(stream, field, format.precision);
        else if (field.type == FieldType::label) writeBinaryList<std::int32_t>(stream, field.values);
        else writeBinaryList<float>(stream, field.values);
        stream << ";\n";
    });
}

}
