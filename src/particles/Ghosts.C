// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Ghosts.H"

#include "device/Algorithms.H"
#include "device/Atomic.H"
#include "device/CountUp.H"
#include "particles/HiddenValues.H"

#include <algorithm>
#include <utility>

namespace shizuku
{

namespace
{

struct Invert
{
    Span<const std::uint32_t> order;
    Span<std::uint32_t> now;

    HOST_DEVICE void operator()(int i) const { now[int(order[i])] = std::uint32_t(i); }
};

// How many particles of a chunk are sent.
struct CountSeen
{
    Span<const std::uint32_t> sent;
    Span<std::uint32_t> seen;

    HOST_DEVICE void operator()(int k) const { increment(seen[int(sent[k]) / Chunks::size]); }
};

struct IsSeen
{
    Span<const std::uint32_t> seen;
    Span<std::uint8_t> is;

    HOST_DEVICE void operator()(int chunk) const { is[chunk] = seen[chunk] > 0; }
};

struct EdgeFirst
{
    Span<const std::uint32_t> before;       // of each chunk and of the end: how many at the edge
    Span<std::uint32_t> chunks;

    HOST_DEVICE void operator()(int chunk) const
    {
        const int edges = int(before[chunk]), all = int(before[before.size - 1]);
        const bool isEdge = before[chunk + 1] != before[chunk];
        chunks[isEdge ? edges : all + chunk - edges] = std::uint32_t(chunk);
    }
};

struct Renumber
{
    Span<const std::uint32_t> now;
    Span<std::uint32_t> indices;

    HOST_DEVICE void operator()(int k) const { indices[k] = now[int(indices[k])]; }
};

}

void Ghosts::join(const Communicator& communicator)
{
    communicator_ = {std::shared_ptr<void>(), &communicator};
    link_ = linkDevices(communicator);
}

int Ghosts::set(Buffer<std::uint32_t> sent, const std::vector<Exchange::Count>& seen, int owned)
{
    const int taken = exchange_.set(parts(), std::move(sent), seen);
    owned_ = owned;
    received_.resizeDiscarding(taken);
    forEach(taken, CountUp{received_.span(), std::uint32_t(owned)});
    return taken;
}

int Ghosts::set(Images::List sent, const std::vector<Exchange::Count>& seen, Images::List own, int owned)
{
    Buffer<AtSides> received;
    owned_ = owned;
    if (parts().parts() > 1)
    {
        received.resizeDiscarding(set(std::move(sent.particle), seen, owned));
        exchange_.packInOrder({valuesOf(sent.across)});
        pass(exchange_);
        Buffer<std::uint32_t> indices(received.size());
        forEach(indices.size(), CountUp{indices.span(), 0});
        exchange_.unpack({valuesOf(received)}, std::as_const(indices).span());
    }
    return images_->set(owned, received, std::move(own));
}

void Ghosts::reorder(const Buffer<std::uint32_t>& order)
{
    Buffer<std::uint32_t> now(order.size());
    forEach(order.size(), Invert{order.span(), now.span()});
    if (images_) images_->reorder(std::as_const(now).span());
    if (parts().parts() == 1) return;
    for (Buffer<std::uint32_t>* list : {&exchange_.sent(), &received_}) forEach(list->size(), Renumber{now.span(), list->span()});
    findEdge();
}

void Ghosts::findEdge()
{
    const int n = Chunks::countOf(owned_);
    Buffer<std::uint32_t> seen(n);
    Buffer<std::uint8_t> isEdge(n);
    seen.setZero();
    forEach(exchange_.sent().size(), CountSeen{std::as_const(exchange_).sent().span(), seen.span()});
    forEach(n, IsSeen{seen.span(), isEdge.span()});
    Selection edge;
    select(isEdge, edge, n, readEdges_);
    chunks_.resizeDiscarding(n);
    edges_.reset();
    forEach(n, EdgeFirst{edge.before.span(), chunks_.span()});
}

int Ghosts::edges() const
{
    if (!edges_) edges_ = int(*readEdges_.wait());
    return *edges_;
}

void Ghosts::declare(const FieldRegistry& fields, const Columns& read, GhostsHave have) const
{
    declared_ = read;
    if (poisons_ && have != GhostsHave::valuesOfIteration) poison(fields, owned_, read, have == GhostsHave::valuesOfSearch);
}

void Ghosts::copy(const Columns& values, GhostsOf which) const
{
    if (values.empty()) return;
    if (images_) which = GhostsOf::all;             // each is mapped once
    if (parts().parts() > 1)
    {
        exchange_.pack(values, which);
        pass(exchange_);
        exchange_.unpack(values, received_.span(), which);
    }
    if (images_) images_->copy(values);
}

void Ghosts::gather(const std::byte* own, const std::vector<std::size_t>& sizes, std::byte* all) const
{
    const int part = parts().part();
    std::vector<SentPiece> sent;
    std::vector<ReceivedPiece> received;
    for (int k = 0; k < parts().parts(); all += sizes[k++])
    {
        if (k == part) device::copyOnDevice(all, own, sizes[k]);
        else
        {
            if (sizes[part] > 0) sent.push_back({k, own, sizes[part]});
            if (sizes[k] > 0) received.push_back({k, all, sizes[k]});
        }
    }
    if (link_) link_->exchange(sent, received);
}

void Ghosts::send(const Columns& values, GhostsOf which) const
{
    {
        const device::Beside here;
        exchange_.pack(values, which);
    }
    link_->begin(exchange_.out(), exchange_.in());
}

void Ghosts::receive(const Columns& values, GhostsOf which) const
{
    link_->end();
    const device::Beside here;
    exchange_.unpack(values, received_.span(), which);
}

}
