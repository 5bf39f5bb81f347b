// SPDX-License-Identifier: GPL-3.0-or-later
#include "optics/LiquidRays.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shizuku
{

namespace
{

constexpr int mostBounces = 6;
constexpr double leastWeight = 0.015;       // of a ray that is followed

Vector3 mirrored(const Vector3& direction, const Vector3& normal) { return direction - 2*dot(direction, normal)*normal; }

// Snell's law; normal against the direction, ratio: index on this side over that on the other. Nothing at total reflection.
std::optional<Vector3> refracted(const Vector3& direction, const Vector3& normal, double ratio)
{
    const double cosine = -dot(direction, normal), squared = 1 - ratio*ratio*(1 - cosine*cosine);
    if (squared <= 0) return std::nullopt;
    return normalized(ratio*direction + (ratio*cosine - std::sqrt(squared))*normal);
}

// Fresnel's mean of both polarisations.
double mirroredPart(const Vector3& direction, const Vector3& onward, const Vector3& normal, double ratio)
{
    const double in = -dot(direction, normal), out = -dot(onward, normal);
    const double across = (ratio*in - out)/(ratio*in + out), along = (in - ratio*out)/(in + ratio*out);
    return 0.5*(across*across + along*along);
}

}

LiquidRays::LiquidRays(const TriangleMesh& mesh, const LiquidLook& look, double width)
: mesh_(mesh), tree_(mesh), look_(look), width_(width), small_(1e-6*width)
{}

std::optional<double> LiquidRays::meets(const Vector3& from, const Vector3& direction) const
{
    const auto hit = tree_.first(from, direction, small_, std::numeric_limits<double>::max());
    return hit ? std::optional(hit->distance) : std::nullopt;
}

std::optional<LiquidRays::Meeting> LiquidRays::meeting(const Vector3& from, const Vector3& direction) const
{
    const auto hit = tree_.first(from, direction, small_, std::numeric_limits<double>::max());
    if (!hit) return std::nullopt;
    const auto& [i, j, k] = mesh_.faces[hit->face];
    const Vector3 flat = normalized(cross(mesh_.vertices[j] - mesh_.vertices[i], mesh_.vertices[k] - mesh_.vertices[i]));
    const bool leaves = dot(direction, flat) > 0;
    Vector3 normal = (1 - hit->second - hit->third)*mesh_.normals[i] + hit->second*mesh_.normals[j] + hit->third*mesh_.normals[k];
    if (leaves) normal = -normal;
    // At the outline a normal between those of the corners may look away.
    if (!(squaredLength(normal) > 0) || dot(normal, direction) >= 0) normal = leaves ? -flat : flat;
    return Meeting{hit->distance, from + hit->distance*direction, normalized(normal), flat, leaves};
}

Colour LiquidRays::passed(double distance) const
{
    const auto part = [&](double passes) { return std::pow(passes, distance/width_); };
    return {part(look_.passes.x), part(look_.passes.y), part(look_.passes.z)};
}

Colour LiquidRays::seen(const Vector3& from, const Vector3& direction, const LiquidSurroundings& around) const
{
    return seen(from, direction, around, 1, 0);
}

Colour LiquidRays::seen(const Vector3& from, const Vector3& direction, const LiquidSurroundings& around, double weight, int bounces) const
{
    const auto meet = meeting(from, direction);
    if (!meet || bounces > mostBounces || (look_.isMetal && meet->leaves)) return around.seen(from, direction);
    const Vector3 mirror = mirrored(direction, meet->normal);
    const double cosine = -dot(direction, meet->normal);
    if (look_.isMetal)
    {
        const double edge = std::pow(1 - cosine, 5);
        const Colour part = look_.mirrors + edge*(Colour(1, 1, 1) - look_.mirrors);
        return times(part, seen(meet->place, mirror, around, weight, bounces + 1));
    }
    const bool cameInOpen = meet->leaves && bounces == 0;
    const Colour way = meet->leaves && !cameInOpen ? passed(meet->distance) : Colour(1, 1, 1);
    if (const auto wall = around.wall(meet->place, meet->outward)) return times(way, around.seen(*wall - small_*direction, direction));
    if (cameInOpen) return seen(meet->place, direction, around, weight, bounces);
    const double ratio = meet->leaves ? look_.index : 1/look_.index;
    const auto onward = refracted(direction, meet->normal, ratio);
    const double part = onward ? mirroredPart(direction, *onward, meet->normal, ratio) : 1;
    const double left = weight*std::max({way.x, way.y, way.z});
    Colour sum;
    if (part*left > leastWeight) sum += part*seen(meet->place, mirror, around, part*left, bounces + 1);
    if (onward && (1 - part)*left > leastWeight) sum += (1 - part)*seen(meet->place, *onward, around, (1 - part)*left, bounces + 1);
    return times(way, sum);
}

std::optional<LiquidRays::Light> LiquidRays::through(const Vector3& from, const Vector3& direction, const LiquidSurroundings& around) const
{
    Light light{{1, 1, 1}, from, direction};
    for (int bounce = 0; bounce <= mostBounces; ++bounce)
    {
        const auto meet = meeting(light.from, light.direction);
        if (!meet) return light;
        if (look_.isMetal) return std::nullopt;
        const bool cameInOpen = meet->leaves && bounce == 0;
        if (meet->leaves && !cameInOpen) light.left = times(light.left, passed(meet->distance));
        light.from = meet->place;
        if (const auto wall = around.wall(meet->place, meet->outward)) return Light{light.left, *wall, {}};
        if (cameInOpen) continue;
        const double ratio = meet->leaves ? look_.index : 1/look_.index;
        const auto onward = refracted(light.direction, meet->normal, ratio);
        if (onward)
        {
            light.left *= 1 - mirroredPart(light.direction, *onward, meet->normal, ratio);
            light.direction = *onward;
        }
        else light.direction = mirrored(light.direction, meet->normal);
    }
    return std::nullopt;
}

}
