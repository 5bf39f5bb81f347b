// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Ghosts.H"

namespace shizuku
{

void Ghosts::set(std::vector<Indices> sent, std::vector<Indices> received)
{
    sent_.clear();
    received_.clear();
    for (const Indices& indices : sent) sent_.emplace_back(indices);
    for (const Indices& indices : received) received_.emplace_back(indices);
}

void Ghosts::reorder(const Buffer<std::uint32_t>& order)
{
    const Indices before = order.download();
    Indices now(before.size());
    for (std::size_t i = 0; i < before.size(); ++i) now[before[i]] = std::uint32_t(i);
    for (std::vector<Buffer<std::uint32_t>>* lists : {&sent_, &received_})
    {
        for (Buffer<std::uint32_t>& list : *lists)
        {
            Indices indices = list.download();
            for (std::uint32_t& i : indices) i = now[i];
            list.upload(indices);
        }
    }
}

template void Ghosts::copy(Buffer<scalar>&) const;
template void Ghosts::copy(Buffer<Vec3>&) const;
template void Ghosts::copy(Buffer<Position>&) const;
template void Ghosts::copy(Buffer<std::uint32_t>&) const;
template void Ghosts::copy(Buffer<std::uint8_t>&) const;

}
