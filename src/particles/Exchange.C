// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Exchange.H"

#include "device/CountUp.H"
#include "device/ForEach.H"

#include <utility>

namespace shizuku
{

int Exchange::set(const Communicator& communicator, Buffer<std::uint32_t> sent, const std::vector<Count>& counts)
{
    const int parts = communicator.parts(), part = communicator.part();
    std::vector<Count> all(parts * parts);
    communicator.gather(counts.data(), parts * sizeof(Count), all.data());
    sentSections_.clear();
    receivedSections_.clear();
    int given = 0, taken = 0;
    for (int k = 0; k < parts; ++k)
    {
        const Count give = counts[k], take = all[k * parts + part];
        if (give.all > 0) sentSections_.push_back({k, given, give});
        if (take.all > 0) receivedSections_.push_back({k, taken, take});
        given += give.all;
        taken += take.all;
    }
    sent_ = std::move(sent);
    return taken;
}

template<class Piece>
std::vector<Piece> Exchange::piecesOf(const std::vector<Section>& sections, GhostsOf which, std::size_t record, RecordMemory& memory)
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

void Exchange::packInOrder(const Columns& values)
{
    Buffer<std::uint32_t> indices(sent_.size());
    forEach(indices.size(), CountUp{indices.span(), 0});
    pack(values, GhostsOf::all, std::as_const(indices).span());
}

void Exchange::pack(const Columns& values, GhostsOf which, Span<const std::uint32_t> indices)
{
    const std::size_t record = recordOf(values);
    outPieces_ = piecesOf<SentPiece>(sentSections_, which, record, out_);
    inPieces_ = piecesOf<ReceivedPiece>(receivedSections_, which, record, in_);
    auto piece = outPieces_.begin();
    for (const Section& section : sentSections_)
    {
        const int count = section.of(which);
        if (count == 0) continue;
        shizuku::pack(values, {indices.data + section.first, count}, const_cast<std::byte*>(piece->bytes));
        ++piece;
    }
}

void Exchange::unpack(const Columns& values, Span<const std::uint32_t> indices, GhostsOf which) const
{
    auto piece = inPieces_.begin();
    for (const Section& section : receivedSections_)
    {
        const int count = section.of(which);
        if (count == 0) continue;
        shizuku::unpack(piece->bytes, {indices.data + section.first, count}, values);
        ++piece;
    }
}

}
