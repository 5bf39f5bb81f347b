// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/LiquidFiles.H"

#include "caseFiles/VectorField.H"
#include "core/dictionary/Dictionary.H"

namespace shizuku
{

double readSpacing(const std::filesystem::path& casePath)
{
    return Dictionary::read(casePath/"system/solution").lookupPositive("spacing", dimensions::length);
}

std::vector<Vector3> readLiquidPositions(const std::filesystem::path& timePath, std::optional<double> spacing)
{
    const std::filesystem::path file = timePath/"liquid/positions";
    const FieldData positions = readField(file, FieldType::vector, dimensions::length);
    if (spacing) refuseOtherSpacing(file, positions.spacing, *spacing);
    return toVectors(positions, positions.elements());
}

std::vector<Vector3> readLiquidPositions(const std::filesystem::path& timePath, const ChooseElements& choose)
{
    const FieldData positions = readField(timePath/"liquid/positions", choose, FieldType::vector, dimensions::length);
    if (!positions.uniform) return toVectors(positions, positions.elements());
    const ElementRange range = choose(1);
    return toVectors(positions, range.end - range.first);
}

std::filesystem::path liquidSurfaceFile(const std::filesystem::path& timePath, const std::string& format)
{
    return timePath/"surface"/("liquid." + format);
}

}
