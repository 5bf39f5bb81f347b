// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Surfaces.H"

#include <algorithm>
#include <map>
#include <sstream>

namespace shizuku::test
{

PatchedSurface rectangle(double width, double height)
{
    PatchedSurface surface;
    surface.mesh.vertices = {{0, 0, 0}, {width, 0, 0}, {width, height, 0}, {0, height, 0}};
    surface.mesh.faces = {{0, 1, 2}, {0, 2, 3}};
    surface.patch = {0, 0};
    surface.patches = {"flat"};
    return surface;
}

PatchedSurface cube(double edge)
{
    PatchedSurface surface;
    for (int i = 0; i < 8; ++i) surface.mesh.vertices.emplace_back(edge*(i & 1), edge*((i >> 1) & 1), edge*(i >> 2));
    const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : quads)
    {
        surface.mesh.faces.push_back({q[0], q[1], q[2]});
        surface.mesh.faces.push_back({q[0], q[2], q[3]});
    }
    surface.patch.assign(12, 0);
    surface.patches = {"cube"};
    return surface;
}

PatchedSurface sphere(double radius, int refinements)
{
    PatchedSurface surface = cube(2);
    auto& vertices = surface.mesh.vertices;
    for (Vector3& v : vertices) v = normalized(v - Vector3(1, 1, 1));
    for (int level = 0; level < refinements; ++level)
    {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b)
        {
            const auto [place, isNew] = middles.try_emplace(std::minmax(a, b), int(vertices.size()));
            if (isNew) vertices.push_back(normalized(vertices[a] + vertices[b]));
            return place->second;
        };
        std::vector<std::array<int, 3>> finer;
        for (const auto& [a, b, c] : surface.mesh.faces)
        {
            const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        surface.mesh.faces = finer;
    }
    for (Vector3& v : vertices) v *= radius;
    surface.patch.assign(surface.mesh.faces.size(), 0);
    surface.patches = {"sphere"};
    return surface;
}

PatchedSurface soupOf(const PatchedSurface& surface)
{
    PatchedSurface soup;
    soup.patch = surface.patch;
    soup.patches = surface.patches;
    for (const auto& face : surface.mesh.faces)
    {
        const int first = static_cast<int>(soup.mesh.vertices.size());
        for (int v : face) soup.mesh.vertices.push_back(surface.mesh.vertices[v]);
        soup.mesh.faces.push_back({first, first + 1, first + 2});
    }
    return soup;
}

std::string stlText(const PatchedSurface& surface)
{
    std::ostringstream text;
    text.precision(9);
    for (std::size_t p = 0; p < surface.patches.size(); ++p)
    {
        text << "solid " << surface.patches[p] << "\n";
        for (std::size_t f = 0; f < surface.mesh.faces.size(); ++f)
        {
            if (surface.patch[f] != int(p)) continue;
            text << "facet normal 0 0 0\nouter loop\n";
            for (int v : surface.mesh.faces[f])
            {
                const Vector3& x = surface.mesh.vertices[v];
                text << "vertex " << x.x << " " << x.y << " " << x.z << "\n";
            }
            text << "endloop\nendfacet\n";
        }
        text << "endsolid " << surface.patches[p] << "\n";
    }
    return text.str();
}

std::string stlText(PatchedSurface surface, const std::string& solid)
{
    surface.patch.assign(surface.mesh.faces.size(), 0);
    surface.patches = {solid};
    return stlText(surface);
}

}
