// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/DropNumbers.H"

#include <algorithm>

namespace shizuku
{

std::vector<int> DropNumbers::assign(const std::vector<Vector3>& centroids)
{
    struct Pair { double distance; std::size_t drop, known; };
    std::vector<Pair> pairs;
    for (std::size_t drop = 0; drop < centroids.size(); ++drop)
    {
        for (std::size_t k = 0; k < known_.size(); ++k)
        {
            pairs.push_back({length(centroids[drop] - known_[k].centroid), drop, k});
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.distance < b.distance; });

    std::vector<int> numbers(centroids.size(), 0);
    std::vector<bool> taken(known_.size(), false);
    for (const Pair& pair : pairs)
    {
        if (numbers[pair.drop] != 0 || taken[pair.known]) continue;
        numbers[pair.drop] = known_[pair.known].number;
        taken[pair.known] = true;
    }

    known_.clear();
    for (std::size_t drop = 0; drop < centroids.size(); ++drop)
    {
        if (numbers[drop] == 0) numbers[drop] = ++last_;
        known_.push_back({numbers[drop], centroids[drop]});
    }
    return numbers;
}

}
