// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Ghosts.H"

#include "device/ForEach.H"

#include <numeric>

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

struct Renumber
{
    Span<const std::uint32_t> now;
    Span<std::uint32_t> indices;

    HOST_DEVICE void operator()(int k) const { indices[k] = now[int(indices[k])]; }
};

}

void Ghosts::set(const Indices& sent, std::vector<int> sentCounts, std::vector<int> receivedCounts, int first)
{
    Indices received(std::accumulate(receivedCounts.begin(), receivedCounts.end(), 0));
    std::iota(received.begin(), received.end(), std::uint32_t(first));
    sent_.upload(sent);
    received_.upload(received);
    sentCounts_ = std::move(sentCounts);
    receivedCounts_ = std::move(receivedCounts);
}

void Ghosts::reorder(const Buffer<std::uint32_t>& order)
{
    Buffer<std::uint32_t> now(order.size());
    forEach(order.size(), Invert{order.span(), now.span()});
    for (Buffer<std::uint32_t>* list : {&sent_, &received_}) forEach(list->size(), Renumber{now.span(), list->span()});
}

void Ghosts::exchange(std::size_t each) const
{
    std::vector<SentPiece> sent;
    std::vector<ReceivedPiece> received;
    const std::byte* out = out_.data();
    std::byte* in = in_.data();
    for (int k = 0; k < int(sentCounts_.size()); ++k)
    {
        const std::size_t give = sentCounts_[k] * each, take = receivedCounts_[k] * each;
        if (give > 0) sent.push_back({k, out, give});
        if (take > 0) received.push_back({k, in, take});
        out += give;
        in += take;
    }
    parts().exchange(sent, received);
}

template void Ghosts::copy(Buffer<scalar>&) const;
template void Ghosts::copy(Buffer<Vec3>&) const;
template void Ghosts::copy(Buffer<Position>&) const;
template void Ghosts::copy(Buffer<std::uint32_t>&) const;
template void Ghosts::copy(Buffer<std::uint8_t>&) const;
template void Ghosts::copy(const Selection&, Buffer<scalar>&) const;
template void Ghosts::copy(const Selection&, Buffer<Vec3>&) const;

}
