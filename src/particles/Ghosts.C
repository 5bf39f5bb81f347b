// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Ghosts.H"

#include "device/Algorithms.H"
#include "device/Atomic.H"

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

struct CountUp
{
    Span<std::uint32_t> indices;
    std::uint32_t first;

    HOST_DEVICE void operator()(int k) const { indices[k] = first + std::uint32_t(k); }
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

int Ghosts::set(Buffer<std::uint32_t> sent, const std::vector<Seen>& seen, int owned)
{
    const int parts = this->parts().parts(), part = this->parts().part();
    std::vector<Seen> all(parts * parts);
    this->parts().gather(seen.data(), parts * sizeof(Seen), all.data());
    sentSections_.clear();
    receivedSections_.clear();
    int given = 0, taken = 0;
    for (int k = 0; k < parts; ++k)
    {
        const Seen give = seen[k], take = all[k * parts + part];
        if (give.all > 0) sentSections_.push_back({k, given, give});
        if (take.all > 0) receivedSections_.push_back({k, taken, take});
        given += give.all;
        taken += take.all;
    }
    sent_ = std::move(sent);
    owned_ = owned;
    received_.resizeDiscarding(taken);
    forEach(taken, CountUp{received_.span(), std::uint32_t(owned)});
    return taken;
}

void Ghosts::reorder(const Buffer<std::uint32_t>& order)
{
    Buffer<std::uint32_t> now(order.size());
    forEach(order.size(), Invert{order.span(), now.span()});
    for (Buffer<std::uint32_t>* list : {&sent_, &received_}) forEach(list->size(), Renumber{now.span(), list->span()});
    findEdge();
}

void Ghosts::findEdge()
{
    const int n = Chunks::countOf(owned_);
    Buffer<std::uint32_t> seen(n);
    Buffer<std::uint8_t> isEdge(n);
    seen.setZero();
    forEach(sent_.size(), CountSeen{sent_.span(), seen.span()});
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

template<class Piece>
std::vector<Piece> Ghosts::piecesOf(const std::vector<Section>& sections, GhostsOf which, std::size_t record, RecordMemory& memory)
{
    std::vector<Piece> pieces;
    int lines = 0;
    for (const Section& section : sections)
    {
        const std::size_t bytes = section.of(which) * record;
        if (bytes > 0) pieces.push_back({section.part, nullptr, bytes});
        lines += RecordLine::countFor(bytes);
    }
    memory.resizeDiscarding(lines);
    RecordLine* next = memory.span().data;
    for (Piece& piece : pieces)
    {
        piece.bytes = next->of;
        next += RecordLine::countFor(piece.size);
    }
    return pieces;
}

void Ghosts::packSent(const Columns& values, GhostsOf which) const
{
    const std::size_t record = recordOf(values);
    outPieces_ = piecesOf<SentPiece>(sentSections_, which, record, out_);
    inPieces_ = piecesOf<ReceivedPiece>(receivedSections_, which, record, in_);
    auto piece = outPieces_.begin();
    for (const Section& section : sentSections_)
    {
        const int count = section.of(which);
        if (count == 0) continue;
        pack(values, {sent_.span().data + section.first, count}, const_cast<std::byte*>(piece->bytes));
        ++piece;
    }
}

void Ghosts::unpackReceived(const Columns& values, GhostsOf which) const
{
    auto piece = inPieces_.begin();
    for (const Section& section : receivedSections_)
    {
        const int count = section.of(which);
        if (count == 0) continue;
        unpack(piece->bytes, {received_.span().data + section.first, count}, values);
        ++piece;
    }
}

void Ghosts::copy(const Columns& values, GhostsOf which) const
{
    if (parts().parts() == 1) return;
    packSent(values, which);
    link_->exchange(outPieces_, inPieces_);
    unpackReceived(values, which);
}

void Ghosts::gather(const std::byte* own, std::size_t size, std::byte* all) const
{
    const int part = parts().part();
    device::copyOnDevice(all + part * size, own, size);
    std::vector<SentPiece> sent;
    std::vector<ReceivedPiece> received;
    for (int k = 0; k < parts().parts(); ++k)
    {
        if (k == part) continue;
        sent.push_back({k, own, size});
        received.push_back({k, all + k * size, size});
    }
    if (link_) link_->exchange(sent, received);
}

void Ghosts::send(const Columns& values, GhostsOf which) const
{
    {
        const device::Beside here;
        packSent(values, which);
    }
    link_->begin(outPieces_, inPieces_);
}

void Ghosts::receive(const Columns& values, GhostsOf which) const
{
    link_->end();
    const device::Beside here;
    unpackReceived(values, which);
}

}
