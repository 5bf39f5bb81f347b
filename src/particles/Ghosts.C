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

struct CountUp
{
    Span<std::uint32_t> indices;
    std::uint32_t first;

    HOST_DEVICE void operator()(int k) const { indices[k] = first + std::uint32_t(k); }
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

int Ghosts::set(Buffer<std::uint32_t> sent, std::vector<int> sentCounts, int first)
{
    const int parts = this->parts().parts(), part = this->parts().part();
    std::vector<int> all(parts * parts);
    this->parts().gather(sentCounts.data(), parts * sizeof(int), all.data());
    receivedCounts_.resize(parts);
    for (int k = 0; k < parts; ++k) receivedCounts_[k] = all[k * parts + part];
    sentCounts_ = std::move(sentCounts);
    sent_ = std::move(sent);
    received_.resizeDiscarding(std::accumulate(receivedCounts_.begin(), receivedCounts_.end(), 0));
    forEach(received_.size(), CountUp{received_.span(), std::uint32_t(first)});
    return received_.size();
}

void Ghosts::reorder(const Buffer<std::uint32_t>& order)
{
    Buffer<std::uint32_t> now(order.size());
    forEach(order.size(), Invert{order.span(), now.span()});
    for (Buffer<std::uint32_t>* list : {&sent_, &received_}) forEach(list->size(), Renumber{now.span(), list->span()});
}

void Ghosts::exchange(const std::byte* out, std::byte* in, std::size_t each) const
{
    std::vector<SentPiece> sent;
    std::vector<ReceivedPiece> received;
    for (int k = 0; k < int(sentCounts_.size()); ++k)
    {
        const std::size_t give = sentCounts_[k] * each, take = receivedCounts_[k] * each;
        if (give > 0) sent.push_back({k, out, give});
        if (take > 0) received.push_back({k, in, take});
        out += give;
        in += take;
    }
    link_->exchange(sent, received);
}

template void Ghosts::copy(Buffer<scalar>&) const;
template void Ghosts::copy(Buffer<Vec3>&) const;
template void Ghosts::copy(Buffer<Position>&) const;
template void Ghosts::copy(Buffer<std::uint32_t>&) const;
template void Ghosts::copy(Buffer<std::uint8_t>&) const;
template void Ghosts::copy(const Selection&, Buffer<scalar>&) const;
template void Ghosts::copy(const Selection&, Buffer<Vec3>&) const;

}
