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

// A running mean along the rows of the image.
void blurRows(std::vector<float>& values, int size, int radius, float outside)
{
    std::vector<float> line(size);
    for (int row = 0; row < size; ++row)
    {
        float* const first = values.data() + std::size_t(row)*size;
        double sum = 0;
        const auto value = [&](int i) { return i < 0 || i >= size ? outside : first[i]; };
        for (int i = -radius; i <= radius; ++i) sum += value(i);
        for (int i = 0; i < size; ++i)
        {
            line[i] = float(std::max(0.0, sum)/(2*radius + 1));
            sum += value(i + radius + 1) - value(i - radius);
        }
        std::copy(line.begin(), line.end(), first);
    }
}

// A running mean along the columns, of all columns row by row: memory is read in its order.
void blurColumns(std::vector<float>& values, int size, int radius, float outside)
{
    const std::vector<float> given = values;
    const std::vector<float> beyond(size, outside);
    const auto rowOf = [&](int row) { return row < 0 || row >= size ? beyond.data() : given.data() + std::size_t(row)*size; };
    std::vector<double> sums(size, 0.0);
    for (int row = -radius; row <= radius; ++row)
    {
        const float* const entering = rowOf(row);
        for (int column = 0; column < size; ++column) sums[column] += entering[column];
    }
    for (int row = 0; row < size; ++row)
    {
        const float* const entering = rowOf(row + radius + 1);
        const float* const leaving = rowOf(row - radius);
        float* const mean = values.data() + std::size_t(row)*size;
        for (int column = 0; column < size; ++column)
        {
            mean[column] = float(std::max(0.0, sums[column])/(2*radius + 1));
            sums[column] += entering[column] - leaving[column];
        }
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
        blurRows(image.values, image.size, pixels, outside);
        blurColumns(image.values, image.size, pixels, outside);
    }
}

}
