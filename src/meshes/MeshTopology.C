// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/MeshTopology.H"

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <map>

namespace shizuku
{

namespace
{

struct Edge
{
    int low, high;
    bool ascending;     // the face runs from low to high

    friend bool operator<(const Edge& a, const Edge& b)
    {
        return a.low != b.low ? a.low < b.low : a.high < b.high;
    }
    bool joins(const Edge& b) const { return low == b.low && high == b.high; }
};

}

MeshDefects findDefects(const TriangleMesh& mesh)
{
    MeshDefects defects;
    std::vector<Edge> edges;
    edges.reserve(3*mesh.faces.size());
    for (const auto& face : mesh.faces)
    {
        if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0])
        {
            ++defects.degenerateFaces;
            continue;
        }
        for (int side = 0; side < 3; ++side)
        {
            const int from = face[side], to = face[(side + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to), from < to});
        }
    }
    std::sort(edges.begin(), edges.end());

    for (auto first = edges.begin(); first != edges.end();)
    {
        const auto last = std::find_if(first, edges.end(), [&](const Edge& e) { return !e.joins(*first); });
        const auto faces = last - first;
        if (faces == 1) ++defects.boundaryEdges;
        else if (faces > 2) ++defects.nonManifoldEdges;
        else if (first->ascending == (first + 1)->ascending) ++defects.flippedEdges;
        first = last;
    }
    return defects;
}

TriangleMesh withSharedVertices(const TriangleMesh& mesh)
{
    TriangleMesh result;
    std::map<std::array<double, 3>, int> indices;
    const auto indexOf = [&](const Vector3& v)
    {
        // 0 and -0 are the same place.
        const auto [entry, isNew] = indices.try_emplace({v.x + 0.0, v.y + 0.0, v.z + 0.0}, int(result.vertices.size()));
        if (isNew) result.vertices.push_back(v);
        return entry->second;
    };
    for (const auto& [i, j, k] : mesh.faces)
    {
        const int a = indexOf(mesh.vertices[i]), b = indexOf(mesh.vertices[j]), c = indexOf(mesh.vertices[k]);
        if (a != b && b != c && c != a) result.faces.push_back({a, b, c});
    }
    return result;
}

std::vector<TriangleMesh> connectedComponents(const TriangleMesh& mesh)
{
    boost::disjoint_sets_with_storage<> sets(mesh.vertices.size());
    for (const auto& [i, j, k] : mesh.faces)
    {
        sets.union_set(i, j);
        sets.union_set(j, k);
    }

    std::vector<TriangleMesh> components;
    std::vector<int> componentOfRoot(mesh.vertices.size(), -1), indexInComponent(mesh.vertices.size(), -1);
    for (const auto& face : mesh.faces)
    {
        int& component = componentOfRoot[sets.find_set(face[0])];
        if (component < 0)
        {
            component = int(components.size());
            components.emplace_back();
        }
        TriangleMesh& piece = components[component];
        auto& newFace = piece.faces.emplace_back();
        for (int corner = 0; corner < 3; ++corner)
        {
            int& index = indexInComponent[face[corner]];
            if (index < 0)
            {
                index = int(piece.vertices.size());
                piece.vertices.push_back(mesh.vertices[face[corner]]);
                if (!mesh.normals.empty()) piece.normals.push_back(mesh.normals[face[corner]]);
            }
            newFace[corner] = index;
        }
    }
    return components;
}

}
