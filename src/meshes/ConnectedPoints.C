// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/ConnectedPoints.H"

#include "meshes/Bounds.H"
#include "meshes/PointGrid.H"

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

namespace shizuku
{

namespace
{

// Points in the order of their cells, as wide as `distance`: row by row, layer by layer.
struct SortedPoints
{
    static constexpr std::uint64_t one = 1, row = one << 21, layer = one << 42;

    std::vector<int> index;
    std::vector<std::uint64_t> cell;
    std::vector<Vector3> at;

    SortedPoints(const std::vector<Vector3>& points, double distance)
    {
        const Vector3 low = boundsOf(points).low;
        // None is the first one or the last one of a row. What is farther than a row is long shares the last.
        const auto cellAt = [&](double far) { return one + std::uint64_t(std::clamp(far/distance, 0.0, double(row - 4))); };
        std::vector<std::pair<std::uint64_t, int>> order;
        order.reserve(points.size());
        for (std::size_t i = 0; i < points.size(); ++i)
        {
            const Vector3 far = points[i] - low;
            order.emplace_back(cellAt(far.x) | cellAt(far.y)*row | cellAt(far.z)*layer, int(i));
        }
        std::sort(order.begin(), order.end());
        cell.reserve(points.size());
        index.reserve(points.size());
        at.reserve(points.size());
        for (const auto& [key, i] : order)
        {
            cell.push_back(key);
            index.push_back(i);
            at.push_back(points[i]);
        }
    }

    // visit(i, j) for each pair whose cells are the same or touch, by places in the order.
    template<class Visit>
    void forEachPair(Visit visit) const
    {
        const std::size_t n = index.size();
        for (std::size_t i = 0; i < n; ++i)
        {
            for (std::size_t j = i + 1; j < n && cell[j] <= cell[i] + one; ++j) visit(i, j);
        }
        for (const std::uint64_t beside : {row, layer - row, layer, layer + row})
        {
            std::size_t first = 0;
            for (std::size_t i = 0; i < n; ++i)
            {
                const std::uint64_t middle = cell[i] + beside;
                while (first < n && cell[first] < middle - one) ++first;
                for (std::size_t j = first; j < n && cell[j] <= middle + one; ++j) visit(i, j);
            }
        }
    }
};

}

std::vector<std::vector<int>> connectedPoints(const std::vector<Vector3>& points, double distance)
{
    const SortedPoints sorted(points, distance);
    boost::disjoint_sets_with_storage<> sets(points.size());
    sorted.forEachPair([&](std::size_t i, std::size_t j)
    {
        const std::size_t a = sets.find_set(i), b = sets.find_set(j);
        if (a != b && squaredLength(sorted.at[i] - sorted.at[j]) <= distance*distance) sets.link(a, b);
    });
    std::vector<std::vector<int>> groups;
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> place(points.size()), groupOf(points.size(), none);
    for (std::size_t k = 0; k < points.size(); ++k) place[sorted.index[k]] = k;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        std::size_t& group = groupOf[sets.find_set(place[i])];
        if (group == none)
        {
            group = groups.size();
            groups.emplace_back();
        }
        groups[group].push_back(int(i));
    }
    std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return groups;
}

PointGaps measureGaps(const std::vector<Vector3>& points, double reach)
{
    const PointGrid grid(reach, points);
    PointGaps gaps;
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        double nearest2 = std::numeric_limits<double>::infinity();
        grid.forEachWithin(points[i], reach, [&](int j, double d2)
        {
            if (j != int(i)) nearest2 = std::min(nearest2, d2);
        });
        if (!std::isfinite(nearest2))
        {
            ++gaps.alone;
            continue;
        }
        const double nearest = std::sqrt(nearest2);
        gaps.least = count == 0 ? nearest : std::min(gaps.least, nearest);
        gaps.most = std::max(gaps.most, nearest);
        sum += nearest;
        ++count;
    }
    if (count > 0) gaps.mean = sum/double(count);
    return gaps;
}

}
