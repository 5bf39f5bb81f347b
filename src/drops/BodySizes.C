// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/BodySizes.H"

#include "drops/SeparateBodies.H"
#include "meshes/Bounds.H"
#include "meshes/ConnectedPoints.H"
#include "parallel/AllParts.H"

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <functional>
#include <numeric>

namespace shizuku
{

namespace
{

// A particle for another part, and the piece of a body that it is in: of all parts, numbered from the first part's first.
struct PieceParticle
{
    Vector3 position;
    int piece;
};

// Two pieces of one body.
struct Joint
{
    int piece, other;
};

class Pieces
{
public:
    // The positions and the communicator are referred to, not copied.
    Pieces(const std::vector<Vector3>& positions, double spacing, const Communicator& parts)
    :
        reach_(bodyReach*spacing), parts_(parts), positions_(positions), piece_(positions.size())
    {
        const std::vector<std::vector<int>> groups = connectedPoints(positions, reach_);
        const std::vector<int> counts = parts.gather(int(groups.size()));
        int piece = std::accumulate(counts.begin(), counts.begin() + parts.part(), 0);
        for (const std::vector<int>& group : groups)
        {
            for (const int i : group) piece_[i] = piece;
            sizes_.push_back(int(group.size()));
            ++piece;
        }
    }

    const std::vector<int>& sizes() const { return sizes_; }

    // Those that this part's pieces have with pieces of parts behind it.
    std::vector<Joint> joints() const
    {
        const std::vector<Bounds> boxes = parts_.gather(boundsOf(positions_));
        std::vector<Bytes> to(parts_.parts());
        for (int k = 0; k < parts_.part(); ++k) to[k] = bytesOf(near(boxes[k]));
        const std::vector<Bytes> from = parts_.exchange(std::move(to));
        std::vector<Joint> joints;
        for (int k = parts_.part() + 1; k < parts_.parts(); ++k)
        {
            std::vector<PieceParticle> both = near(boxes[k]);
            const std::size_t mine = both.size();
            appendTo(both, from[k]);
            if (mine > 0 && mine < both.size()) join(both, joints);
        }
        return joints;
    }

    // Those that pieces have across cyclic sides; in part 0. All parts come to it together.
    std::vector<Joint> jointsAcross(const BoxSides& sides) const
    {
        std::vector<PieceParticle> some;
        for (std::size_t i = 0; i < positions_.size(); ++i)
        {
            bool isNear = false;
            for (int c = 0; c < 3; ++c) isNear = isNear || shiftAcross(sides, c, positions_[i]) != 0;
            if (isNear) some.push_back({positions_[i], piece_[i]});
        }
        std::vector<PieceParticle> both = gatherListsAtFirst(parts_, some);
        std::vector<Joint> joints;
        // Behind an axis there are the images across the sides of those before, and so those across edges and corners.
        for (int c = 0; c < 3; ++c)
        {
            for (std::size_t i = 0, before = both.size(); i < before; ++i)
            {
                PieceParticle image = both[i];
                const double shift = shiftAcross(sides, c, image.position);
                image.position[c] += shift;
                if (shift != 0) both.push_back(image);
            }
        }
        join(both, joints);
        return joints;
    }

private:
    // By how far the image of a place that is as near to a cyclic side of an axis as particles of a body are to each other is from it; else 0.
    double shiftAcross(const BoxSides& sides, int axis, const Vector3& x) const
    {
        if (!sides.isCyclic(axis)) return 0;
        const double low = sides.at[axis][0], high = sides.at[axis][1];
        if (x[axis] < low + reach_) return high - low;
        return x[axis] > high - reach_ ? low - high : 0;
    }

    // Those as near to a box as particles of a body are to each other.
    std::vector<PieceParticle> near(const Bounds& box) const
    {
        std::vector<PieceParticle> some;
        for (std::size_t i = 0; i < positions_.size(); ++i)
        {
            const Vector3& x = positions_[i];
            bool is = true;
            for (int c = 0; c < 3; ++c) is = is && x[c] >= box.low[c] - reach_ && x[c] <= box.high[c] + reach_;
            if (is) some.push_back({x, piece_[i]});
        }
        return some;
    }

    void join(const std::vector<PieceParticle>& both, std::vector<Joint>& joints) const
    {
        std::vector<Vector3> positions;
        for (const PieceParticle& particle : both) positions.push_back(particle.position);
        for (const std::vector<int>& group : connectedPoints(positions, reach_))
        {
            const int piece = both[group.front()].piece;
            for (const int i : group)
            {
                if (both[i].piece != piece) joints.push_back({piece, both[i].piece});
            }
        }
    }

    double reach_;
    const Communicator& parts_;
    const std::vector<Vector3>& positions_;
    std::vector<int> piece_;            // of each particle
    std::vector<int> sizes_;            // of the pieces, in particles
};

}

std::vector<int> bodySizes(const std::vector<Vector3>& positions, double spacing, const Communicator& parts, const BoxSides* sides)
{
    const Pieces own(positions, spacing, parts);
    std::vector<Joint> found = own.joints();
    if (sides)
    {
        const std::vector<Joint> across = own.jointsAcross(*sides);
        found.insert(found.end(), across.begin(), across.end());
    }
    const std::vector<Joint> joints = gatherListsAtFirst(parts, found);
    const std::vector<int> pieces = gatherListsAtFirst(parts, own.sizes());
    boost::disjoint_sets_with_storage<> sets(pieces.size());
    for (const Joint& joint : joints) sets.union_set(joint.piece, joint.other);
    std::vector<int> sizes(pieces.size(), 0);
    for (std::size_t k = 0; k < pieces.size(); ++k) sizes[sets.find_set(k)] += pieces[k];
    std::erase(sizes, 0);
    std::sort(sizes.begin(), sizes.end(), std::greater<int>());
    return sizes;
}

}
