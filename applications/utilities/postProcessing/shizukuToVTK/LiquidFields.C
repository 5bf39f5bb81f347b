// SPDX-License-Identifier: GPL-3.0-or-later
#include "LiquidFields.H"

#include <set>

namespace shizuku
{

namespace
{

std::set<std::string> namesIn(const std::filesystem::path& folder)
{
    std::set<std::string> names;
    if (!std::filesystem::is_directory(folder)) return names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
    {
        const std::string name = entry.path().filename().string();
        if (entry.is_regular_file() && name != "positions" && name.front() != '.') names.insert(name);
    }
    return names;
}

}

LiquidFields::LiquidFields
(
    const std::vector<TimeFolder>& times, const std::optional<std::vector<std::string>>& wanted
)
{
    std::set<std::string> found;
    for (const TimeFolder& time : times) found.merge(namesIn(time.path/"liquid"));
    const std::vector<std::string> all(found.begin(), found.end());
    for (const std::string& name : wanted.value_or(all))
    {
        if (found.contains(name)) names_.push_back(name);
        else throw FatalInputError({}, "No selected time has a field '" + name + "' of the liquid", "", all, name);
    }
}

std::vector<FieldData> LiquidFields::read(const std::filesystem::path& timePath, std::size_t particles, const ChooseElements& choose) const
{
    std::vector<FieldData> fields;
    for (const std::string& name : names_)
    {
        const auto file = timePath/"liquid"/name;
        if (std::filesystem::exists(file)) fields.push_back(readField(file, choose, {}, {}, long(particles)));
    }
    return fields;
}

}
