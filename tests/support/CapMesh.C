// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/CapMesh.H"

#include <algorithm>
#include <map>
#include <numbers>
#include <unordered_map>

namespace shizuku::test
{

namespace
{

double radians(double degrees) { return degrees*std::numbers::pi/180; }

// Marching state: the grid's values, and the vertex that each cut edge has got.
class TetrahedraMarch
{
public:
    TetrahedraMarch
    (
        const std::function<double(const Vector3&)>& distance, const Vector3& low, const Vector3& high, double cell
    )
    : low_(low), cell_(cell)
    {
        for (int axis = 0; axis < 3; ++axis) nodes_[axis] = int(std::ceil((high[axis] - low[axis])/cell)) + 1;
        values_.resize(std::size_t(nodes_[0])*nodes_[1]*nodes_[2]);
        for (std::size_t node = 0; node < values_.size(); ++node) values_[node] = distance(position(node));
    }

    TriangleMesh mesh()
    {
        // Kuhn's division of a cube: one tetrahedron for each order in which the axes are walked.
        std::array<int, 3> axes{0, 1, 2};
        do
        {
            for (int i = 0; i + 1 < nodes_[0]; ++i)
            {
                for (int j = 0; j + 1 < nodes_[1]; ++j)
                {
                    for (int k = 0; k + 1 < nodes_[2]; ++k)
                    {
                        if (!isCut({i, j, k})) continue;
                        std::array<std::size_t, 4> corners;
                        std::array<int, 3> at{i, j, k};
                        corners[0] = index(at);
                        for (int step = 0; step < 3; ++step)
                        {
                            ++at[axes[step]];
                            corners[step + 1] = index(at);
                        }
                        cut(corners);
                    }
                }
            }
        }
        while (std::next_permutation(axes.begin(), axes.end()));
        return std::move(mesh_);
    }

private:
    std::size_t index(const std::array<int, 3>& at) const
    {
        return (std::size_t(at[0])*nodes_[1] + at[1])*nodes_[2] + at[2];
    }

    // Whether the surface passes through the cube that begins there.
    bool isCut(const std::array<int, 3>& at) const
    {
        int inside = 0;
        for (int corner = 0; corner < 8; ++corner)
        {
            inside += values_[index({at[0] + (corner & 1), at[1] + (corner >> 1 & 1), at[2] + (corner >> 2)})] < 0;
        }
        return inside > 0 && inside < 8;
    }

    Vector3 position(std::size_t node) const
    {
        const auto k = node % nodes_[2], j = node/nodes_[2] % nodes_[1], i = node/nodes_[2]/nodes_[1];
        return low_ + cell_*Vector3(double(i), double(j), double(k));
    }

    int vertexOn(std::size_t a, std::size_t b)
    {
        if (a > b) std::swap(a, b);
        const auto [entry, isNew] = vertexOfEdge_.try_emplace(a*values_.size() + b, int(mesh_.vertices.size()));
        if (isNew)
        {
            const double t = values_[a]/(values_[a] - values_[b]);
            mesh_.vertices.push_back(position(a) + t*(position(b) - position(a)));
        }
        return entry->second;
    }

    void cut(const std::array<std::size_t, 4>& corners)
    {
        std::vector<std::size_t> in, out;
        for (const std::size_t node : corners) (values_[node] < 0 ? in : out).push_back(node);
        if (in.empty() || out.empty()) return;
        if (in.size() == 2)
        {
            const int a = vertexOn(in[0], out[0]), b = vertexOn(in[0], out[1]);
            const int c = vertexOn(in[1], out[1]), d = vertexOn(in[1], out[0]);
            add({a, b, c}, in[0], out[0]);
            add({a, c, d}, in[0], out[0]);
            return;
        }
        const bool oneInside = in.size() == 1;
        const auto& three = oneInside ? out : in;
        const std::size_t lone = oneInside ? in[0] : out[0];
        add({vertexOn(lone, three[0]), vertexOn(lone, three[1]), vertexOn(lone, three[2])}, in[0], out[0]);
    }

    // Oriented so that `inside` lies behind the face and `outside` before it.
    void add(std::array<int, 3> face, std::size_t inside, std::size_t outside)
    {
        const Vector3& a = mesh_.vertices[face[0]];
        const Vector3 normal = cross(mesh_.vertices[face[1]] - a, mesh_.vertices[face[2]] - a);
        if (dot(normal, position(outside) - position(inside)) < 0) std::swap(face[1], face[2]);
        mesh_.faces.push_back(face);
    }

    Vector3 low_;
    double cell_;
    std::array<int, 3> nodes_{};
    std::vector<double> values_;
    std::unordered_map<std::size_t, int> vertexOfEdge_;
    TriangleMesh mesh_;
};

}

double Cap::contactRadius(double theta) const { return radius*std::sin(radians(theta)); }

double Cap::height() const { return wall.distance(centre) + radius; }

bool Cap::contains(const Vector3& p) const { return wall.distance(p) > 0 && length(p - centre) < radius; }

Cap capOfVolume(double theta, double volume, const Plane& wall, const Vector3& foot)
{
    const double c = std::cos(radians(theta));
    const double radius = std::cbrt(3*volume/(std::numbers::pi*(2 + c)*(1 - c)*(1 - c)));
    return {wall, foot - radius*c*wall.normal, radius};
}

TriangleMesh marchTetrahedra
(
    const std::function<double(const Vector3&)>& distance, const Vector3& low, const Vector3& high, double cell
)
{
    return TetrahedraMarch(distance, low, high, cell).mesh();
}

TriangleMesh capMesh(const Cap& cap, double cell)
{
    const auto distance = [&](const Vector3& p)
    {
        return std::max(length(p - cap.centre) - cap.radius, -cap.wall.distance(p));
    };
    // The box around the part of the sphere above the wall. Along each axis the part reaches as far as the sphere
    // where the sphere's extreme point is above the wall, else as far as the contact circle.
    const double h = cap.wall.distance(cap.centre);
    const double disc = std::sqrt(std::max(0.0, cap.radius*cap.radius - h*h));
    const Vector3 foot = cap.centre - h*cap.wall.normal;
    Vector3 low, high;
    for (int axis = 0; axis < 3; ++axis)
    {
        const double n = cap.wall.normal[axis], tilt = disc*std::sqrt(std::max(0.0, 1 - n*n));
        high[axis] = h + cap.radius*n > 0 ? cap.centre[axis] + cap.radius : foot[axis] + tilt;
        low[axis] = h - cap.radius*n > 0 ? cap.centre[axis] - cap.radius : foot[axis] - tilt;
    }
    // Off the grid by odd fractions, so that no node lies exactly on the wall.
    return marchTetrahedra(distance, low - cell*Vector3(1.37, 1.41, 1.29), high + cell*Vector3(1.5, 1.5, 1.5), cell);
}

TriangleMesh cubeMesh(double side)
{
    TriangleMesh mesh;
    for (int corner = 0; corner < 8; ++corner)
    {
        mesh.vertices.push_back(side*Vector3(corner & 1, corner >> 1 & 1, corner >> 2 & 1));
    }
    mesh.faces =
    {
        {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
        {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}
    };
    return mesh;
}

TriangleMesh icosphereMesh(int levels)
{
    const double g = std::numbers::phi;
    TriangleMesh mesh;
    for (const Vector3& v : std::vector<Vector3>
    {
        {-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
        {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}
    })
    {
        mesh.vertices.push_back(normalized(v));
    }
    mesh.faces =
    {
        {0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11},
        {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
        {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8}, {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}
    };
    for (int level = 0; level < levels; ++level)
    {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b)
        {
            const auto [entry, isNew] = middles.try_emplace(std::minmax(a, b), int(mesh.vertices.size()));
            if (isNew) mesh.vertices.push_back(normalized(mesh.vertices[a] + mesh.vertices[b]));
            return entry->second;
        };
        std::vector<std::array<int, 3>> finer;
        for (const auto& [i, j, k] : mesh.faces)
        {
            const int a = middle(i, j), b = middle(j, k), c = middle(k, i);
            finer.insert(finer.end(), {{i, a, c}, {a, j, b}, {c, b, k}, {a, b, c}});
        }
        mesh.faces = finer;
    }
    return mesh;
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b)
{
    TriangleMesh mesh = a;
    const int offset = int(a.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const auto& [i, j, k] : b.faces) mesh.faces.push_back({i + offset, j + offset, k + offset});
    return mesh;
}

}
