// SPDX-License-Identifier: GPL-3.0-or-later
#include "sampling/EdgeRows.H"

#include <cmath>

namespace shizuku
{

namespace
{

const double sharpCosine = std::sqrt(0.75);     // 30 degrees
constexpr double rowGap = 0.95;                 // between particles of a row, in spacings
constexpr double leastGap = 0.75;               // in spacings
constexpr double step = 0.05;                   // between the places that are tried, in spacings
constexpr double same = 0.01;                   // distance of places that are one, in spacings

// The row along one side of a sharp edge: its places, numbered from the edge's start.
class Row
{
public:
    Row(const ParticleLayer& layer, int face, int k, int other) : layer_(layer), face_(face), other_(other)
    {
        const SurfaceGeometry& surface = layer.surface();
        const Vector3& normal = surface.faceNormal(face);
        const Vector3& otherNormal = surface.faceNormal(other);
        start_ = surface.corners(face)[k];
        edge_ = surface.corners(face)[(k + 1) % 3] - start_;
        last = 1 + static_cast<int>(length(edge_)/(step*layer.spacing()));

        // Both layers are at this distance from the edge where they meet: offset*tan(half the angle of the normals).
        const Vector3 inward = normalized(cross(normal, edge_));
        const double inset = layer.offset()*dot(inward, otherNormal)/(1 + dot(normal, otherNormal));
        exists = std::isfinite(inset) && inset > 0;
        if (!exists) return;
        inset_ = inset*inward;
        otherInset_ = inset*normalized(cross(edge_, otherNormal));
    }

    LayerParticle place(int i) const { return at(face_, i, inset_); }

    // The same place, as one of the other face's layer.
    LayerParticle placeOfOther(int i) const { return at(other_, i, otherInset_); }

    int last = 0;           // place
    bool exists = false;    // not where the layers do not meet

private:
    LayerParticle at(int face, int i, const Vector3& inset) const
    {
        return layer_.particleAt(layer_.surface().move({face, start_ + double(i)/last*edge_}, inset));
    }

    const ParticleLayer& layer_;
    int face_, other_;
    Vector3 start_, edge_, inset_, otherInset_;
};

std::vector<Row> findRows(const ParticleLayer& layer)
{
    const SurfaceGeometry& surface = layer.surface();
    std::vector<Row> rows;
    for (int face = 0; face < surface.faces(); ++face)
    {
        for (int k = 0; k < 3; ++k)
        {
            const int other = surface.neighbour(face, k);
            if (other < 0 || dot(surface.faceNormal(face), surface.faceNormal(other)) > sharpCosine) continue;
            const Row row(layer, face, k, other);
            if (row.exists) rows.push_back(row);
        }
    }
    return rows;
}

}

void addEdgeRows(ParticleLayer& layer)
{
    const std::vector<Row> rows = findRows(layer);
    PointGrid grid = layer.grid(rowGap*layer.spacing());
    const auto isClear = [&](const LayerParticle& particle) { return layer.clear(particle); };
    const auto hasRoom = [&](const LayerParticle& particle, double gap)
    {
        return !grid.anyWithin(particle.position, gap*layer.spacing());
    };
    bool ofOther = false;
    const auto add = [&](const Row& row, int i, const LayerParticle& particle)
    {
        LayerParticle added = particle;
        if (ofOther)
        {
            // Small faces may end before the inset does: there the other face's layer is elsewhere.
            const LayerParticle other = row.placeOfOther(i);
            if (length(other.position - particle.position) < same*layer.spacing()) added = other;
        }
        ofOther = !ofOther;
        added.fixed = true;
        grid.insert(added.position);
        layer.particles().push_back(added);
    };

    // First where rows end at another face, in a corner; every edge has two rows, which start at either end.
    for (const Row& row : rows)
    {
        int i = 0;
        while (i <= row.last && !isClear(row.place(i))) ++i;
        if (i > 0 && i <= row.last && hasRoom(row.place(i), leastGap)) add(row, i, row.place(i));
    }
    for (const double gap : {rowGap, leastGap})
    {
        for (const Row& row : rows)
        {
            for (int i = 0; i <= row.last; ++i)
            {
                const LayerParticle particle = row.place(i);
                if (hasRoom(particle, gap) && isClear(particle)) add(row, i, particle);       // the second takes longer
            }
        }
    }
}

}
