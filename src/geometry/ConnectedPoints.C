#include "geometry/ConnectedPoints.H"

#include "geometry/sampling/PointGrid.H"

#include <algorithm>

namespace shizuku
{

std::vector<std::vector<int>> connectedPoints(const std::vector<Vector3>& points, double distance)
{
    const PointGrid grid(distance, points);
    std::vector<char> found(points.size(), 0);
    std::vector<std::vector<int>> groups;
    for (std::size_t first = 0; first < points.size(); ++first)
    {
        if (found[first]) continue;
        std::vector<int> group{int(first)};
        found[first] = 1;
        for (std::size_t next = 0; next < group.size(); ++next)
        {
            grid.forEachWithin(points[group[next]], distance, [&](int j, double)
            {
                if (found[j]) return;
                found[j] = 1;
                group.push_back(j);
            });
        }
        groups.push_back(std::move(group));
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
