// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/TriangleTree.H"

#include "meshes/Bounds.H"

#include <algorithm>
#include <numeric>

namespace shizuku
{

namespace
{

constexpr int mostInLeaf = 4;                     // triangles
constexpr int deepestTree = 64;                 // of the tree: it halves 2^31 faces at the most

// Whether the ray passes the box before `farthest`; inverse: of its direction's components.
bool passesBox(const Vector3& low, const Vector3& high, const Vector3& from, const Vector3& inverse, double farthest)
{
    double enters = 0, leaves = farthest;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double a = (low[axis] - from[axis])*inverse[axis], b = (high[axis] - from[axis])*inverse[axis];
        enters = std::max(enters, std::min(a, b));
        leaves = std::min(leaves, std::max(a, b));
    }
    return enters <= leaves;
}

}

TriangleTree::TriangleTree(const TriangleMesh& mesh) : mesh_(mesh), order_(mesh.faces.size())
{
    std::iota(order_.begin(), order_.end(), 0);
    centres_.reserve(mesh.faces.size());
    for (const auto& [i, j, k] : mesh.faces) centres_.push_back((mesh.vertices[i] + mesh.vertices[j] + mesh.vertices[k])/3);
    if (!order_.empty()) split(0, int(order_.size()));
}

void TriangleTree::split(int first, int count)
{
    Bounds box, centres;
    for (int k = first; k < first + count; ++k)
    {
        for (const int v : mesh_.faces[order_[k]]) box.add(mesh_.vertices[v]);
        centres.add(centres_[order_[k]]);
    }
    const int node = int(nodes_.size());
    nodes_.push_back({box.low, box.high, first, count});
    if (count <= mostInLeaf) return;
    const Vector3 size = centres.high - centres.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto begin = order_.begin() + first, middle = begin + count/2;
    std::nth_element(begin, middle, begin + count, [&](int a, int b) { return centres_[a][axis] < centres_[b][axis]; });
    split(first, count/2);
    nodes_[node].count = 0;
    nodes_[node].first = int(nodes_.size());
    split(first + count/2, count - count/2);
}

std::optional<TriangleTree::Hit> TriangleTree::first(const Vector3& from, const Vector3& direction, double nearest, double farthest) const
{
    if (nodes_.empty()) return std::nullopt;
    const Vector3 inverse(1/direction.x, 1/direction.y, 1/direction.z);
    Hit hit{farthest};
    bool found = false;
    int stack[deepestTree], top = 0;
    stack[top++] = 0;
    while (top > 0)
    {
        const int k = stack[--top];
        const Node& node = nodes_[k];
        if (!passesBox(node.low, node.high, from, inverse, hit.distance)) continue;
        if (node.count == 0)
        {
            stack[top++] = node.first;
            stack[top++] = k + 1;
            continue;
        }
        for (int i = node.first; i < node.first + node.count; ++i) meet(order_[i], from, direction, nearest, hit, found);
    }
    return found ? std::optional(hit) : std::nullopt;
}

// Moeller and Trumbore 1997.
void TriangleTree::meet(int face, const Vector3& from, const Vector3& direction, double nearest, Hit& hit, bool& found) const
{
    const auto& [i, j, k] = mesh_.faces[face];
    const Vector3 a = mesh_.vertices[j] - mesh_.vertices[i], b = mesh_.vertices[k] - mesh_.vertices[i];
    const Vector3 p = cross(direction, b);
    const double determinant = dot(a, p);
    if (determinant == 0) return;
    const Vector3 s = from - mesh_.vertices[i];
    const double second = dot(s, p)/determinant;
    if (second < 0 || second > 1) return;
    const Vector3 q = cross(s, a);
    const double third = dot(direction, q)/determinant;
    if (third < 0 || second + third > 1) return;
    const double distance = dot(b, q)/determinant;
    if (distance <= nearest || distance >= hit.distance) return;
    hit = {distance, face, second, third};
    found = true;
}

}
