// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/BodyNumbers.H"

#include "core/fieldFile/FieldFile.H"
#include "core/paths/Existence.H"
#include "drops/SeparateBodies.H"
#include "meshes/ConnectedPoints.H"

#include <map>
#include <numeric>

namespace shizuku
{

std::vector<long> readLiquidIds(const std::filesystem::path& timePath, std::size_t particles)
{
    std::vector<long> ids(particles);
    std::iota(ids.begin(), ids.end(), 0L);
    const auto file = timePath/"liquid/id";
    if (!isThere(file)) return ids;
    const FieldData field = readField(file, FieldType::label, dimensions::none, long(particles));
    for (std::size_t i = 0; i < particles; ++i) ids[i] = long(field(i, 0));
    return ids;
}

std::vector<int> BodyNumbers::next(const std::vector<Vector3>& particles, const std::vector<long>& ids)
{
    std::vector<int> numbers(particles.size());
    std::vector<bool> isTaken(std::size_t(last_) + 1, false);
    for (const std::vector<int>& body : connectedPoints(particles, bodyReach*spacing_))
    {
        const int number = numberOf(body, ids, isTaken);
        for (const int i : body) numbers[i] = number;
    }
    known_.clear();
    for (std::size_t i = 0; i < ids.size(); ++i) known_[ids[i]] = numbers[i];
    return numbers;
}

int BodyNumbers::numberOf(const std::vector<int>& body, const std::vector<long>& ids, std::vector<bool>& isTaken)
{
    std::map<int, int> votes;
    for (const int i : body)
    {
        const auto known = known_.find(ids[i]);
        if (known != known_.end() && !isTaken[known->second]) ++votes[known->second];
    }
    int chosen = 0, most = 0;
    for (const auto& [number, count] : votes)
    {
        if (count <= most) continue;
        most = count;
        chosen = number;
    }
    if (chosen == 0) return ++last_;
    isTaken[chosen] = true;
    return chosen;
}

}
