// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Images.H"

#include "device/Algorithms.H"
#include "device/CountUp.H"
#include "device/ForEach.H"
#include "maths/PackedDeviator.H"
#include "maths/PackedRows.H"

#include <utility>

namespace shizuku
{

namespace
{

HOST_DEVICE inline int axesOf(AtSides at) { return (at.along(0) != 0) + (at.along(1) != 0) + (at.along(2) != 0); }

// One for each choice of the axes along which a particle is at a side, but that of none.
HOST_DEVICE inline int imagesOf(AtSides at) { return (1 << axesOf(at)) - 1; }

struct CountImages
{
    SideMaps sides;
    std::int64_t reach;
    Span<const Position> x;
    Span<std::uint32_t> count;

    HOST_DEVICE void operator()(int i) const { count[i] = std::uint32_t(imagesOf(sides.within(reach, placeOf(x[i])))); }
};

struct ListImages
{
    SideMaps sides;
    std::int64_t reach;
    Span<const Position> x;
    Span<const std::uint32_t> start;
    Span<std::uint32_t> particle;
    Span<AtSides> at;

    HOST_DEVICE void operator()(int i) const
    {
        const AtSides near = sides.within(reach, placeOf(x[i]));
        int k = int(start[i]);
        for (int choice = 1; choice <= imagesOf(near); ++choice, ++k)
        {
            particle[k] = std::uint32_t(i);
            at[k] = chosen(near, choice);
        }
    }

private:
    // Of the axes along which it is at a side those whose bits are set.
    HOST_DEVICE static AtSides chosen(AtSides near, int choice)
    {
        AtSides at;
        for (int axis = 0, bit = 0; axis < 3; ++axis)
        {
            const int side = near.along(axis);
            if (side == AtSides::neither) continue;
            if (choice >> bit & 1) at.set(axis, side);
            ++bit;
        }
        return at;
    }
};

struct RenumberImages
{
    Span<const std::uint32_t> image;
    Span<const AtSides> at;
    Span<std::uint32_t> id;

    HOST_DEVICE void operator()(int k) const
    {
        constexpr int highest = 29;             // the last three bits: along which axes
        const std::uint32_t axes = (at[k].along(0) != 0) | (at[k].along(1) != 0) << 1 | (at[k].along(2) != 0) << 2;
        id[int(image[k])] ^= axes << highest;
    }
};

struct FollowOrder
{
    Span<const std::uint32_t> now;
    Span<std::uint32_t> indices;

    HOST_DEVICE void operator()(int k) const { indices[k] = now[int(indices[k])]; }
};

// What is copied to an image, across its sides.
struct MapValues
{
    SideMaps sides;
    Span<const std::uint32_t> image;
    Span<const AtSides> at;
    std::byte* values;
    int stride;
    Column::Kind kind;
    const std::uint32_t* before;

    HOST_DEVICE void operator()(int k) const
    {
        using Kind = Column::Kind;
        if (at[k].bits == 0) return;            // a copy of another part's particle
        std::size_t place = image[k];
        if (before)
        {
            const std::size_t own = before[place];
            if (before[place + 1] == own) return;
            place = own;
        }
        std::byte* const value = values + place * stride;
        Position& p = *reinterpret_cast<Position*>(value);
        Vec3& v = *reinterpret_cast<Vec3*>(value);
        if (kind == Kind::positions) p = sides.imageOf(p, at[k]);
        else if (kind == Kind::places)
        {
            const Position mapped = sides.imageOfLow(p, at[k]);
            p.x = mapped.x;
            p.y = mapped.y;
            p.z = mapped.z;
        }
        else if (kind == Kind::vectors) v = sides.imageOf(v, at[k]);
        else if (kind == Kind::deviators) v = deviator(v, at[k]);
        else if (kind == Kind::rows) v = mirrored(v, sides.sign(0, at[k]), sides.sign(1, at[k]), sides.sign(2, at[k]));
    }

private:
    HOST_DEVICE Vec3 deviator(Vec3 words, AtSides across) const
    {
        const scalar x = sides.sign(0, across), y = sides.sign(1, across), z = sides.sign(2, across);
        if (x * y > 0 && y * z > 0) return words;
        const auto own = unpacked(words);
        return packed(SymmTensor<Vec3>{own.diagonal, {x * y * own.other.x, y * z * own.other.y, z * x * own.other.z}});
    }
};

}

Images::List Images::find(Span<const Position> places, int owned, scalar reach) const
{
    const SideMaps& maps = sides_.maps();
    const std::int64_t near = quanta::wholeOf(reach);
    Buffer<std::uint32_t> count(owned), start;
    forEach(owned, CountImages{maps, near, places, count.span()});
    const int images = int(exclusiveScan(count, start, "images of particles"));
    List list{Buffer<std::uint32_t>(images), Buffer<AtSides>(images)};
    forEach(owned, ListImages{maps, near, places, std::as_const(start).span(), list.particle.span(), list.across.span()});
    return list;
}

int Images::set(int owned, const Buffer<AtSides>& received, List own)
{
    const int sent = received.size(), images = own.particle.size();
    across_.resizeDiscarding(sent + images);
    if (sent > 0) device::copyOnDevice(across_.span().data, received.span().data, sent * sizeof(AtSides));
    if (images > 0) device::copyOnDevice(across_.span().data + sent, std::as_const(own.across).span().data, images * sizeof(AtSides));
    ghost_.resizeDiscarding(sent + images);
    forEach(sent + images, CountUp{ghost_.span(), std::uint32_t(owned)});
    particle_ = std::move(own.particle);
    return sent + images;
}

void Images::renumber(Buffer<std::uint32_t>& id) const
{
    forEach(ghost_.size(), RenumberImages{ghost_.span(), across_.span(), id.span()});
}

void Images::reorder(Span<const std::uint32_t> now)
{
    for (Buffer<std::uint32_t>* list : {&particle_, &ghost_}) forEach(list->size(), FollowOrder{now, list->span()});
}

void Images::copy(const Columns& values) const
{
    const int n = ghost_.size(), own = particle_.size();
    if (n == 0 || values.empty()) return;
    if (own > 0)
    {
        RecordMemory records(RecordLine::countFor(own * recordOf(values)));
        std::byte* const bytes = reinterpret_cast<std::byte*>(records.span().data);
        pack(values, particle_.span(), bytes);
        unpack(bytes, {ghost_.span().data + n - own, own}, values);
    }
    for (const Column& column : values)
    {
        const bool isPlace = column.kind == Column::Kind::places || column.kind == Column::Kind::positions;
        if (column.kind == Column::Kind::numbers || (!isPlace && !sides_.box().has(Sides::Kind::symmetryPlane))) continue;
        forEach(n, MapValues{sides_.maps(), ghost_.span(), across_.span(), column.values, column.stride, column.kind, column.before});
    }
}

}
