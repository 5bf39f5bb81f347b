// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/Shapes.H"

#include "support/Surfaces.H"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace shizuku::test
{

namespace
{

constexpr double pi = std::numbers::pi;

PatchedSurface named(TriangleMesh mesh, const std::string& name)
{
    PatchedSurface surface;
    surface.mesh = std::move(mesh);
    surface.patch.assign(surface.mesh.faces.size(), 0);
    surface.patches = {name};
    return surface;
}

double turn(const std::array<double, 2>& a, const std::array<double, 2>& b, const std::array<double, 2>& c)
{
    return (b[0] - a[0])*(c[1] - a[1]) - (b[1] - a[1])*(c[0] - a[0]);
}

// Ear clipping.
std::vector<std::array<int, 3>> triangulate(const Outline& outline)
{
    std::vector<int> rest(outline.size());
    for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = int(i);
    std::vector<std::array<int, 3>> faces;
    const auto isEar = [&](int a, int b, int c)
    {
        if (turn(outline[a], outline[b], outline[c]) <= 0) return false;
        return std::none_of(rest.begin(), rest.end(), [&](int p)
        {
            return p != a && p != b && p != c && turn(outline[a], outline[b], outline[p]) >= 0
                && turn(outline[b], outline[c], outline[p]) >= 0 && turn(outline[c], outline[a], outline[p]) >= 0;
        });
    };
    for (std::size_t i = 0, tried = 0; rest.size() > 2 && tried <= rest.size(); ++tried)
    {
        const std::size_t n = rest.size();
        const int a = rest[i % n], b = rest[(i + 1) % n], c = rest[(i + 2) % n];
        if (isEar(a, b, c))
        {
            faces.push_back({a, b, c});
            rest.erase(rest.begin() + long((i + 1) % n));
            tried = 0;
        }
        ++i;
    }
    return faces;
}

template<class Change> void atRandomFaces(std::size_t faces, double part, Change change)
{
    std::mt19937 random(7);
    for (std::size_t f = 0; f < faces; ++f)
    {
        if (double(random())/double(std::mt19937::max()) < part) change(f);
    }
}

}

PatchedSurface patchOf
(
    const std::string& name, int nu, int nv, bool closedU, bool closedV, const std::function<Vector3(double, double)>& f
)
{
    const int mu = closedU ? nu : nu + 1, mv = closedV ? nv : nv + 1;
    TriangleMesh mesh;
    for (int j = 0; j < mv; ++j) for (int i = 0; i < mu; ++i) mesh.vertices.push_back(f(double(i)/nu, double(j)/nv));
    for (int j = 0; j < nv; ++j)
    {
        for (int i = 0; i < nu; ++i)
        {
            const int a = i + mu*j, b = (i + 1) % mu + mu*j, c = (i + 1) % mu + mu*((j + 1) % mv), d = i + mu*((j + 1) % mv);
            mesh.faces.push_back({a, b, c});
            mesh.faces.push_back({a, c, d});
        }
    }
    return named(mesh, name);
}

PatchedSurface box(const Vector3& low, const Vector3& high)
{
    PatchedSurface surface = cube(1);
    for (Vector3& v : surface.mesh.vertices) for (int c = 0; c < 3; ++c) v[c] = low[c] + v[c]*(high[c] - low[c]);
    surface.patches = {"box"};
    return surface;
}

PatchedSurface torus(double majorRadius, double minorRadius, int cells)
{
    const int around = std::max(12, int(cells*minorRadius/majorRadius));
    return patchOf("torus", cells, around, true, true, [&](double u, double v)
    {
        const double a = 2*pi*u, b = 2*pi*v, r = majorRadius + minorRadius*std::cos(b);
        return Vector3(r*std::cos(a), r*std::sin(a), minorRadius*std::sin(b));
    });
}

PatchedSurface blob(double radius, int refinements)
{
    PatchedSurface surface = sphere(1, refinements);
    for (Vector3& v : surface.mesh.vertices)
    {
        double r = 1 + 0.08*std::sin(5*v.x)*std::cos(4*v.y + 3*v.z) - 0.25*std::exp(-12*v.z*v.z);
        for (const double side : {-0.5, 0.5})
        {
            const double cosine = dot(v, normalized(Vector3(side, 0.1, 0.85)));
            r += 0.7*std::exp(25*(cosine - 1));
        }
        v *= r*radius;
    }
    surface.patches = {"blob"};
    return surface;
}

PatchedSurface cylinder(double radius, double height, int cells)
{
    const auto rim = [&](double u, double r, double z)
    {
        return Vector3(r*std::cos(2*pi*u), r*std::sin(2*pi*u), z);
    };
    const PatchedSurface side =
        patchOf("side", cells, 1, true, false, [&](double u, double v) { return rim(u, radius, v*height); });
    TriangleMesh bottom, top;
    bottom.vertices = {{0, 0, 0}};
    top.vertices = {{0, 0, height}};
    for (int i = 0; i < cells; ++i)
    {
        bottom.vertices.push_back(rim(double(i)/cells, radius, 0));
        top.vertices.push_back(rim(double(i)/cells, radius, height));
        bottom.faces.push_back({0, 1 + (i + 1) % cells, 1 + i});
        top.faces.push_back({0, 1 + i, 1 + (i + 1) % cells});
    }
    return joined(joined(side, named(bottom, "bottom")), named(top, "top"));
}

PatchedSurface cone(double radius, double height, int cells)
{
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 0}, {0, 0, height}};
    for (int i = 0; i < cells; ++i)
    {
        const double a = 2*pi*i/cells;
        mesh.vertices.emplace_back(radius*std::cos(a), radius*std::sin(a), 0);
        const int here = 2 + i, next = 2 + (i + 1) % cells;
        mesh.faces.push_back({0, next, here});
        mesh.faces.push_back({1, here, next});
    }
    return named(mesh, "cone");
}

PatchedSurface terrain(double edge, double amplitude, int cells)
{
    return patchOf("terrain", cells, cells, false, false, [&](double u, double v)
    {
        const double saddle = 2*((u - 0.5)*(u - 0.5) - (v - 0.5)*(v - 0.5));
        const double hills = 0.5*std::sin(11*u + 1)*std::sin(9*v) + 0.15*std::sin(31*u)*std::cos(27*v + 2);
        return Vector3(edge*u, edge*v, amplitude*(saddle + hills));
    });
}

PatchedSurface extrusion(const std::string& name, const Outline& outline, double height)
{
    const int n = int(outline.size());
    TriangleMesh mesh;
    for (const double z : {0.0, height}) for (const auto& p : outline) mesh.vertices.emplace_back(p[0], p[1], z);
    for (const auto& [a, b, c] : triangulate(outline))
    {
        mesh.faces.push_back({c, b, a});
        mesh.faces.push_back({a + n, b + n, c + n});
    }
    for (int i = 0; i < n; ++i)
    {
        const int j = (i + 1) % n;
        mesh.faces.push_back({i, j, j + n});
        mesh.faces.push_back({i, j + n, i + n});
    }
    return named(mesh, name);
}

Outline gearOutline(int teeth, double inner, double outer)
{
    Outline outline;
    for (int i = 0; i < teeth; ++i)
    {
        const double corner[4][2] = {{0, inner}, {0.35, inner}, {0.5, outer}, {0.85, outer}};
        for (const auto& [part, r] : corner)
        {
            const double a = 2*pi*(i + part)/teeth;
            outline.push_back({r*std::cos(a), r*std::sin(a)});
        }
    }
    return outline;
}

Outline stairsOutline(int steps, double depth, double rise)
{
    Outline outline{{0, 0}, {steps*depth, 0}};
    for (int i = steps; i > 0; --i)
    {
        outline.push_back({i*depth, (steps - i + 1)*rise});
        outline.push_back({(i - 1)*depth, (steps - i + 1)*rise});
    }
    return outline;
}

std::vector<PatchedSurface> letters(double height, double thickness)
{
    // On a grid of 3 x 5.
    const std::vector<std::pair<std::string, Outline>> outlines
    {
        {"P", {{0, 0}, {1, 0}, {1, 2}, {3, 2}, {3, 5}, {0, 5}}},
        {"L", {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 5}, {0, 5}}},
        {"Y", {{1, 0}, {2, 0}, {2, 2}, {3, 5}, {2, 5}, {1.5, 3.2}, {1, 5}, {0, 5}, {1, 2}}},
        {"H", {{0, 0}, {1, 0}, {1, 2}, {2, 2}, {2, 0}, {3, 0}, {3, 5}, {2, 5}, {2, 3}, {1, 3}, {1, 5}, {0, 5}}},
        {"I", {{1, 0}, {2, 0}, {2, 5}, {1, 5}}},
        {"Z", {{0, 0}, {3, 0}, {3, 1}, {1.3, 1}, {3, 4}, {3, 5}, {0, 5}, {0, 4}, {1.7, 4}, {0, 1}}}
    };
    std::vector<PatchedSurface> result;
    for (const auto& [name, outline] : outlines)
    {
        Outline sized = outline;
        for (auto& p : sized) p = {p[0]*height/5, p[1]*height/5};
        result.push_back(moved(extrusion(name, sized, thickness), {0.8*height*double(result.size()), 0, 0}));
    }
    return result;
}

PatchedSurface tube(const std::function<Vector3(double)>& curve, bool closed, double radius, int along, int around)
{
    const auto centre = [&](double t) { return curve(closed ? t - std::floor(t) : t); };
    // A frame from a fixed direction, which no curve here runs along.
    const Vector3 up = normalized(Vector3(0.05, 0.02, 1));
    PatchedSurface surface = patchOf("tube", around, along, true, closed, [&](double u, double v)
    {
        const Vector3 tangent = normalized(centre(v + 1e-5) - centre(v - 1e-5));
        const Vector3 side = normalized(cross(tangent, up)), top = cross(side, tangent);
        return centre(v) + radius*(std::cos(2*pi*u)*side - std::sin(2*pi*u)*top);
    });
    if (closed) return surface;
    TriangleMesh& mesh = surface.mesh;
    const int last = around*along, first = int(mesh.vertices.size());
    mesh.vertices.push_back(centre(0));
    mesh.vertices.push_back(centre(1));
    for (int i = 0; i < around; ++i)
    {
        const int next = (i + 1) % around;
        mesh.faces.push_back({first, next, i});
        mesh.faces.push_back({first + 1, last + i, last + next});
    }
    surface.patch.assign(mesh.faces.size(), 0);
    return surface;
}

PatchedSurface joined(const PatchedSurface& a, const PatchedSurface& b)
{
    PatchedSurface both = a;
    const int shift = int(a.mesh.vertices.size());
    both.mesh.vertices.insert(both.mesh.vertices.end(), b.mesh.vertices.begin(), b.mesh.vertices.end());
    for (const auto& [i, j, k] : b.mesh.faces) both.mesh.faces.push_back({i + shift, j + shift, k + shift});
    std::vector<int> label;
    for (const std::string& name : b.patches) label.push_back(both.patchIndex(name));
    for (const int patch : b.patch) both.patch.push_back(label[patch]);
    return both;
}

PatchedSurface moved(PatchedSurface surface, const Vector3& by)
{
    for (Vector3& v : surface.mesh.vertices) v += by;
    return surface;
}

PatchedSurface turnedOver(PatchedSurface surface)
{
    for (auto& face : surface.mesh.faces) std::swap(face[0], face[1]);
    return surface;
}

PatchedSurface withNoise(PatchedSurface surface, double amplitude)
{
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, amplitude);
    for (Vector3& v : surface.mesh.vertices) v += Vector3(noise(random), noise(random), noise(random));
    return surface;
}

PatchedSurface withFlippedFaces(PatchedSurface surface, double part)
{
    auto& faces = surface.mesh.faces;
    atRandomFaces(faces.size(), part, [&](std::size_t f) { std::swap(faces[f][0], faces[f][1]); });
    return surface;
}

PatchedSurface withDuplicateFaces(PatchedSurface surface, double part)
{
    atRandomFaces(surface.mesh.faces.size(), part, [&](std::size_t f)
    {
        surface.mesh.faces.push_back(surface.mesh.faces[f]);
        surface.patch.push_back(surface.patch[f]);
    });
    return surface;
}

PatchedSurface withSlivers(PatchedSurface surface, double part)
{
    auto& mesh = surface.mesh;
    atRandomFaces(mesh.faces.size(), part, [&](std::size_t f)
    {
        const auto [a, b, c] = mesh.faces[f];
        mesh.vertices.push_back(0.5*(mesh.vertices[a] + mesh.vertices[b]));
        mesh.faces.push_back({a, b, int(mesh.vertices.size()) - 1});
        surface.patch.push_back(surface.patch[f]);
    });
    return surface;
}

PatchedSurface withHole(PatchedSurface surface, const Vector3& centre, double radius)
{
    PatchedSurface rest = surface;
    rest.mesh.faces.clear();
    rest.patch.clear();
    for (std::size_t f = 0; f < surface.mesh.faces.size(); ++f)
    {
        const auto& face = surface.mesh.faces[f];
        const auto& v = surface.mesh.vertices;
        if (length((v[face[0]] + v[face[1]] + v[face[2]])/3 - centre) < radius) continue;
        rest.mesh.faces.push_back(face);
        rest.patch.push_back(surface.patch[f]);
    }
    return rest;
}

PatchedSurface crackedBox()
{
    const auto top = [](double u, double v) { return Vector3(12*u, 9*v, 7); };
    return joined(withHole(box({0, 0, 0}, {12, 9, 7}), {6, 4.5, 7}, 3), patchOf("box", 5, 3, false, false, top));
}

}
