// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/TipRings.H"

#include "sampling/ThinSolid.H"

#include <numbers>

namespace shizuku
{

namespace
{

constexpr int count = 3;
constexpr double radius = 0.45;             // in spacings: they are 0.78 apart
constexpr double deepest = 8;               // in spacings below the tip
constexpr double turned = 0.1;              // radians: ways along the edges between facets would find neither

// The particles of a tip whose places on the surface are that far [m] below it; fewer where the surface ends before.
std::vector<LayerParticle> ringAt(const ParticleLayer& layer, const Tip& tip, double depth)
{
    const Vector3 aside = std::abs(tip.axis.x) < 0.8 ? Vector3(1, 0, 0) : Vector3(0, 1, 0);
    const Vector3 u = normalized(cross(tip.axis, aside)), v = cross(tip.axis, u), centre = tip.position - depth*tip.axis;
    std::vector<LayerParticle> ring;
    for (int i = 0; i < count; ++i)
    {
        const double angle = turned + 2*std::numbers::pi*i/count;
        const Vector3 outwards = std::cos(angle)*u + std::sin(angle)*v;
        const auto side = layer.distance().behind(centre, outwards, 0, deepest*layer.spacing());
        if (side) ring.push_back(layer.particleAt({side->face, centre + side->distance*outwards}));
    }
    return ring;
}

Vector3 middle(const std::vector<LayerParticle>& ring)
{
    Vector3 sum;
    for (const LayerParticle& particle : ring) sum += particle.position;
    return sum/double(ring.size());
}

// How far the particles are from the axis on the side that they look to, on the average, m.
double radiusOf(const std::vector<LayerParticle>& ring, const Tip& tip)
{
    double sum = 0;
    for (const LayerParticle& particle : ring)
    {
        const Vector3 outwards = normalized(particle.normal - dot(particle.normal, tip.axis)*tip.axis);
        sum += dot(particle.position - tip.position, outwards);
    }
    return sum/count;
}

}

void addTipRings(ParticleLayer& layer)
{
    if (layer.offset() >= 0) return;
    const double spacing = layer.spacing();
    for (const Tip& tip : findTips(layer.surface(), layer.distance(), spacing))
    {
        const auto hasRoom = [&](double depth)
        {
            const auto ring = ringAt(layer, tip, depth);
            return ring.size() == count && radiusOf(ring, tip) >= radius*spacing;
        };
        double low = 0, high = deepest*spacing;
        if (!hasRoom(high)) continue;
        while (high - low > 1e-3*spacing) (hasRoom(0.5*(low + high)) ? high : low) = 0.5*(low + high);
        const auto ring = ringAt(layer, tip, high);
        for (LayerParticle particle : ring)
        {
            particle.fixed = true;
            layer.particles().push_back(particle);
        }
        layer.cutAbove({middle(ring), tip.axis, length(middle(ring) - tip.position) + spacing});
    }
}

}
