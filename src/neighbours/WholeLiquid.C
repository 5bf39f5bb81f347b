// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/WholeLiquid.H"

#include <algorithm>
#include <cstring>

namespace shizuku
{

namespace
{

// Which particle of those that came is the k-th of the whole.
using Order = std::vector<std::uint32_t>;

template<class T>
void append(Bytes& bytes, const Buffer<T>& values, int n)
{
    const std::size_t before = bytes.size();
    bytes.resize(before + n * sizeof(T));
    values.download(reinterpret_cast<T*>(bytes.data() + before), n);
}

// The keys, then one field behind the other.
Bytes packed(const Liquid& part, const Neighbourhood& near)
{
    Bytes bytes;
    append(bytes, near.keysOfWhole(), part.owned());
    for (const auto& entry : part.fields().entries())
    {
        if (entry->info.sorted) std::visit([&](const auto& field) { append(bytes, field, part.owned()); }, entry->values);
    }
    return bytes;
}

// What came of the parts, read value by value.
class Arrived
{
public:
    Arrived(std::vector<Bytes> bytes, std::size_t each) : bytes_(std::move(bytes))
    {
        for (const Bytes& of : bytes_) counts_.push_back(of.size() / each), particles_ += counts_.back();
    }

    std::size_t particles() const { return particles_; }

    // The next field, by part.
    template<class T>
    std::vector<T> next()
    {
        std::vector<T> values(particles_);
        T* to = values.data();
        for (std::size_t k = 0; k < bytes_.size(); to += counts_[k++])
        {
            if (counts_[k] > 0) std::memcpy(to, bytes_[k].data() + counts_[k] * before_, counts_[k] * sizeof(T));
        }
        before_ += sizeof(T);
        return values;
    }

private:
    std::vector<Bytes> bytes_;
    std::vector<std::size_t> counts_;
    std::size_t particles_ = 0;
    std::size_t before_ = 0;            // bytes of a particle that were read
};

template<class T>
Buffer<T>& fieldOf(Liquid& whole, const FieldInfo& info)
{
    FieldRegistry::Entry* entry = whole.fields().find(info.name);
    if (!entry) return whole.fields().add<T>(info);
    entry->info = info;
    return std::get<Buffer<T>>(entry->values);
}

// By key, and by number among those of one key.
Order orderOf(const std::vector<std::uint32_t>& keys, const std::vector<std::uint32_t>& ids)
{
    struct Rank
    {
        std::uint64_t rank;
        std::uint32_t index;
    };
    std::vector<Rank> ranks(keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i) ranks[i] = {std::uint64_t(keys[i]) << 32 | ids[i], std::uint32_t(i)};
    std::sort(ranks.begin(), ranks.end(), [](const Rank& a, const Rank& b) { return a.rank < b.rank; });
    Order order;
    order.reserve(ranks.size());
    for (const Rank& each : ranks) order.push_back(each.index);
    return order;
}

}

void gatherLiquid(const Liquid& part, const Neighbourhood& near, Liquid* whole)
{
    std::size_t each = sizeof(std::uint32_t);
    for (const auto& entry : part.fields().entries())
    {
        if (entry->info.sorted) std::visit([&]<class T>(const Buffer<T>&) { each += sizeof(T); }, entry->values);
    }
    std::vector<Bytes> to(part.parts().parts());
    to[0] = packed(part, near);
    Arrived arrived(part.parts().exchange(std::move(to)), each);
    if (!whole) return;

    whole->resize(int(arrived.particles()));
    const std::vector<std::uint32_t> keys = arrived.next<std::uint32_t>();
    for (const auto& entry : part.fields().entries())
    {
        const FieldInfo& info = entry->info;
        if (info.sorted) std::visit([&]<class T>(const Buffer<T>&) { fieldOf<T>(*whole, info).upload(arrived.next<T>(), 0); }, entry->values);
    }
    const Order order = orderOf(keys, whole->id.download());
    whole->fields().reorder(Buffer<std::uint32_t>(order));
    for (const auto& [name, value] : part.numbers()) whole->setNumber(name, value);
}

}
