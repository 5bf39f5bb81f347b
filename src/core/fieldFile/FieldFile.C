#include "core/fieldFile/FieldFile.H"

#include "core/fieldFile/FieldReader.H"

namespace shizuku
{

namespace
{

FieldData readAll(const std::filesystem::path& file, const FieldReader& reader)
{
    FieldData field{file.filename().string(), reader.type(), reader.dimensions(), reader.uniform(), {}};
    const std::size_t elements = reader.elements();
    field.values.reserve(elements * componentsOf(field.type));
    reader.read(elements, [&](std::size_t, std::span<const double> values)
    {
        field.values.insert(field.values.end(), values.begin(), values.end());
    });
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

FieldData readField(const std::filesystem::path& file, long expectedElements)
{
    return readAll(file, FieldReader(file, std::nullopt, std::nullopt, expectedElements));
}

FieldData readField
(
    const std::filesystem::path& file, FieldType type, const Dimensions& dimensions, long expectedElements
)
{
    return readAll(file, FieldReader(file, type, dimensions, expectedElements));
}

}
