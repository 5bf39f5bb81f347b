// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/VertexNeighbours.H"

namespace shizuku
{

VertexNeighbours::VertexNeighbours(const TriangleMesh& mesh, const std::function<bool(int, int)>& counts) : first_(mesh.vertices.size() + 1, 0)
{
    const auto visit = [&](const auto& take)
    {
        for (const auto& face : mesh.faces)
        {
            for (int corner = 0; corner < 3; ++corner)
            {
                const int i = face[corner];
                for (const int j : {face[(corner + 1) % 3], face[(corner + 2) % 3]})
                {
                    if (!counts || counts(i, j)) take(i, j);
                }
            }
        }
    };
    visit([&](int i, int) { ++first_[i + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    neighbours_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    visit([&](int i, int j) { neighbours_[next[i]++] = j; });
}

std::vector<Vector3> VertexNeighbours::waysToMean(const std::vector<Vector3>& vertices) const
{
    std::vector<Vector3> ways(size());
    for (std::size_t i = 0; i < ways.size(); ++i)
    {
        if (count(i) == 0) continue;
        Vector3 sum;
        forEach(i, [&](int j) { sum += vertices[j]; });
        ways[i] = sum/count(i) - vertices[i];
    }
    return ways;
}

}
