// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fieldFile/FieldFile.H"

#include "core/fieldFile/FieldReader.H"
#include "core/messages/Error.H"

#include <cmath>
#include <sstream>

namespace shizuku
{

namespace
{

FieldData readChosen(const std::filesystem::path& file, const FieldReader& reader, const ChooseElements& choose = {})
{
    FieldData field{file.filename().string(), reader.type(), reader.dimensions(), reader.uniform(), {}, reader.spacing()};
    const ElementRange all{0, reader.elements()}, range = choose && !reader.uniform() ? choose(all.end) : all;
    field.values.reserve((range.end - range.first) * componentsOf(field.type));
    reader.read(range, [&](std::size_t, std::span<const double> values)
    {
        field.values.insert(field.values.end(), values.begin(), values.end());
    });
    return field;
}

}

void refuseOtherSpacing(const std::filesystem::path& file, double found, double wanted)
{
    constexpr double digits = 1e-6;
    if (found == 0 || std::abs(found - wanted) <= digits * wanted) return;
    std::ostringstream text, expected;
    text << "These particles were made at a spacing of " << found << " m, and system/solution has " << wanted << " m";
    expected << "spacing " << found << "; in system/solution, or fillLiquid run again";
    throw FatalInputError({file.string(), 0}, text.str(), expected.str());
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
    return readChosen(file, FieldReader(file, std::nullopt, std::nullopt, expectedElements));
}

FieldData readField
(
    const std::filesystem::path& file, FieldType type, const Dimensions& dimensions, long expectedElements
)
{
    return readChosen(file, FieldReader(file, type, dimensions, expectedElements));
}

FieldData readField
(
    const std::filesystem::path& file, const ChooseElements& choose, std::optional<FieldType> type, std::optional<Dimensions> dimensions,
    long expectedElements
)
{
    return readChosen(file, FieldReader(file, type, dimensions, expectedElements), choose);
}

}
