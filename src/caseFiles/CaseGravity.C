// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/CaseGravity.H"

#include "core/dictionary/Dictionary.H"

namespace shizuku
{

Vector3 caseGravity(const std::filesystem::path& casePath)
{
    const auto models = casePath/"constant/models";
    if (!std::filesystem::exists(models)) return {};
    if (Dictionary::read(models).lookupOr<std::string>("bodyForce", "none") != "gravity") return {};
    return Dictionary::read(casePath/"constant/g").lookupDimensionedVector("value", dimensions::acceleration);
}

}
