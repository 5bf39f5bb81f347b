// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/SoftShadow.H"

#include <algorithm>

namespace shizuku
{

namespace
{

struct Pixel { double column, row; };

void fillTriangle(PlaneImage& image, const std::array<Pixel, 3>& p)
{
    const auto side = [](const Pixel& a, const Pixel& b, double column, double row)
    {
        return (b.column - a.column)*(row - a.row) - (b.row - a.row)*(column - a.column);
    };
    const auto [left, right] = std::minmax({p[0].column, p[1].column, p[2].column});
    const auto [low, high] = std::minmax({p[0].row, p[1].row, p[2].row});
    for (int row = std::max(0, int(std::floor(low))); row <= std::min(image.size - 1, int(std::ceil(high))); ++row)
    {
        for (int column = std::max(0, int(std::floor(left)));
             column <= std::min(image.size - 1, int(std::ceil(right))); ++column)
        {
            const double a = side(p[0], p[1], column, row), b = side(p[1], p[2], column, row);
            const double c = side(p[2], p[0], column, row);
            if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) image.at(column, row) = 1;
        }
    }
}

// A running mean along the lines of the image; `stride` from pixel to pixel, `lineStride` from line to line.
void blurLines(std::vector<float>& values, int size, int radius, int stride, int lineStride, float outside)
{
    std::vector<float> line(size);
    for (int l = 0; l < size; ++l)
    {
        float* const first = values.data() + std::size_t(l)*lineStride;
        double sum = 0;
        const auto value = [&](int i) { return i < 0 || i >= size ? outside : first[std::size_t(i)*stride]; };
        for (int i = -radius; i <= radius; ++i) sum += value(i);
        for (int i = 0; i < size; ++i)
        {
            line[i] = float(std::max(0.0, sum)/(2*radius + 1));
            sum += value(i + radius + 1) - value(i - radius);
        }
        for (int i = 0; i < size; ++i) first[std::size_t(i)*stride] = line[i];
    }
}

}

void castShadow(PlaneImage& window, const TriangleMesh& mesh, const Vector3& light, double blurRadius)
{
    window.values.assign(std::size_t(window.size)*window.size, 0);
    const Vector3 normal = cross(window.right, window.up);
    const double pixelsPerMetre = window.size/(2*window.halfWidth);
    const auto project = [&](const Vector3& vertex)
    {
        const Vector3 fromCentre = vertex - window.centre;
        const Vector3 onPlane = fromCentre - dot(fromCentre, normal)/dot(light, normal)*light;
        return Pixel
        {
            (dot(onPlane, window.right) + window.halfWidth)*pixelsPerMetre - 0.5,
            (dot(onPlane, window.up) + window.halfWidth)*pixelsPerMetre - 0.5
        };
    };
    for (const auto& [i, j, k] : mesh.faces)
    {
        fillTriangle(window, {project(mesh.vertices[i]), project(mesh.vertices[j]), project(mesh.vertices[k])});
    }
    blur(window, blurRadius, 0);
}

void blur(PlaneImage& image, double radius, float outside)
{
    // Three running means are close to a Gaussian bell.
    const int pixels = std::max(1, int(radius*image.size/(2*image.halfWidth)/2));
    for (int pass = 0; pass < 3; ++pass)
    {
        blurLines(image.values, image.size, pixels, 1, image.size, outside);
        blurLines(image.values, image.size, pixels, image.size, 1, outside);
    }
}

}
