// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/ClearLiquid.H"

#include "device/HostThreads.H"
#include "meshes/Creases.H"
#include "meshes/SmoothMesh.H"
#include "vtk/PictureParts.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shizuku
{

namespace
{

// What marching cubes leave of the particles is seen in mirror images alone.
constexpr int normalPasses = 12;

// The pixels around what is thrown onto the plane along the light.
struct PixelRange
{
    int firstColumn = std::numeric_limits<int>::max(), lastColumn = -1, firstRow = firstColumn, lastRow = -1;
};

}

ClearLiquid::ClearLiquid(const PictureScene& scene, const LiquidLook& look, double radius, const Studio& studio)
:
    scene_(scene), studio_(studio), liquid_(smoothMesh(splitCreases(scene.liquid, creaseAngle), 0, normalPasses)), rays_(liquid_, look, 2*radius), walls_(scene.walls)
{}

// The floor's or the nearest place of a wall that is drawn by its surface.
std::optional<Vector3> ClearLiquid::wallOnWay(const Vector3& from, const Vector3& direction) const
{
    double nearest = std::numeric_limits<double>::max();
    if (scene_.floor)
    {
        const double towards = -dot(direction, scene_.floor->normal), away = scene_.floor->distance(from)/towards;
        if (towards > 1e-6 && away > 0) nearest = away;
    }
    if (const auto hit = walls_.first(from, direction, 0, nearest)) nearest = hit->distance;
    if (nearest == std::numeric_limits<double>::max()) return std::nullopt;
    return from + nearest*direction;
}

std::optional<Vector3> ClearLiquid::touchedWall(const Vector3& place, const Vector3& outward) const
{
    const double near = 0.3*scene_.spacing, on = 0.02*scene_.spacing;       // a mesh may be off its wall; triangles on it, beside the contact line, may look anywhere
    constexpr double facing = 0.8;                  // cosine
    if (scene_.floor)
    {
        const double away = scene_.floor->distance(place);
        const bool touches = std::abs(away) < on || (std::abs(away) < near && dot(outward, scene_.floor->normal) < -facing);
        if (touches) return place - away*scene_.floor->normal;
    }
    const auto hit = walls_.first(place - near*outward, outward, 0, 2*near);
    return hit ? std::optional(place + (hit->distance - near)*outward) : std::nullopt;
}

LiquidSurroundings ClearLiquid::around(const PixelImage* picture, const PictureCamera& camera) const
{
    return
    {
        [this, picture, &camera](const Vector3& from, const Vector3& direction)
        {
            const auto wall = wallOnWay(from, direction);
            return wall && camera.depth(*wall) > 0 ? picture->at(camera.placeOf(*wall)) : studio_.light(direction);
        },
        [this](const Vector3& place, const Vector3& outward) { return touchedWall(place, outward); }
    };
}

void ClearLiquid::draw(PixelImage& picture, const PictureCamera& camera) const
{
    const PixelImage behind = picture;
    const LiquidSurroundings around = this->around(&behind, camera);
    forEachInParallel(picture.height, [&](std::size_t row)
    {
        for (int column = 0; column < picture.width; ++column)
        {
            const Vector3 direction = camera.direction((column + 0.5)/picture.width, (double(row) + 0.5)/picture.height);
            const auto distance = rays_.meets(camera.position, direction);
            if (!distance) continue;
            const double depth = *distance*dot(direction, camera.forward);
            // What lies on the liquid's surface, as its wall, is behind it.
            if (depth > behind.depth[row*picture.width + column] + 0.3*scene_.spacing) continue;
            picture.set(column, int(row), rays_.seen(camera.position, direction, around));
        }
    }, 4);
}

void ClearLiquid::castLight(std::array<PlaneImage, 3>& floor, const Vector3& light, double blurRadius) const
{
    PlaneImage& first = floor[0];
    for (PlaneImage& image : floor) image.values.assign(std::size_t(first.size)*first.size, 0);
    const Vector3 normal = cross(first.right, first.up);
    const double perMetre = first.size/(2*first.halfWidth);
    const auto onPlane = [&](const Vector3& place) { return place - dot(place - first.centre, normal)/dot(light, normal)*light; };
    const auto pixelOf = [&](const Vector3& place)
    {
        const Vector3 r = place - first.centre;
        return std::array{int(std::floor((dot(r, first.right) + first.halfWidth)*perMetre)), int(std::floor((dot(r, first.up) + first.halfWidth)*perMetre))};
    };
    PixelRange range;
    double away = 0;
    for (const Vector3& vertex : liquid_.vertices)
    {
        const Vector3 place = onPlane(vertex);
        const auto [column, row] = pixelOf(place);
        range.firstColumn = std::max(0, std::min(range.firstColumn, column));
        range.lastColumn = std::min(first.size - 1, std::max(range.lastColumn, column));
        range.firstRow = std::max(0, std::min(range.firstRow, row));
        range.lastRow = std::min(first.size - 1, std::max(range.lastRow, row));
        away = std::max(away, length(place - vertex));
    }
    const LiquidSurroundings around{{}, [this](const Vector3& place, const Vector3& outward) { return touchedWall(place, outward); }};
    constexpr int samples = 2;              // along each side of a pixel
    for (int row = range.firstRow; row <= range.lastRow; ++row)
    {
        for (int ray = 0; ray < samples*samples*(range.lastColumn - range.firstColumn + 1); ++ray)
        {
            const double column = range.firstColumn + (ray/samples + 0.5)/samples, line = row + (ray%samples + 0.5)/samples;
            const Vector3 place = first.centre + (column/perMetre - first.halfWidth)*first.right + (line/perMetre - first.halfWidth)*first.up;
            const Vector3 from = place - 1.1*away*light;
            if (!rays_.meets(from, light)) continue;
            const double power = 1.0/(samples*samples);
            for (PlaneImage& image : floor) image.at(int(column), row) -= float(power);
            const auto lit = rays_.through(from, light, around);
            if (!lit) continue;
            const bool lands = lit->direction == Vector3() || dot(lit->direction, normal)*dot(light, normal) > 0;
            if (!lands) continue;
            const Vector3 end = lit->direction == Vector3() ? lit->from
                : lit->from - dot(lit->from - first.centre, normal)/dot(lit->direction, normal)*lit->direction;
            const auto [i, j] = pixelOf(end);
            if (i < 0 || j < 0 || i >= first.size || j >= first.size) continue;
            for (int c = 0; c < 3; ++c) floor[c].at(i, j) += float(power*lit->left[c]);
        }
    }
    for (PlaneImage& image : floor)
    {
        for (float& value : image.values) value += 1;
        blur(image, blurRadius, 1);
    }
}

}
