// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/FieldRegistry.H"

#include "device/ForEach.H"

#include <algorithm>

namespace shizuku
{

namespace
{

template<class T>
struct Move
{
    const T* from;
    T* to;
};

// Several fields at once: on a GPU small ones take no longer than one.
struct ReorderFields
{
    static constexpr int most = 4;          // of each type

    Span<const std::uint32_t> order;
    Move<scalar> number[most] = {};
    Move<Vec3> vector[most] = {};
    Move<Position> place[most] = {};
    Move<std::uint32_t> label[most] = {};
    int scalars = 0, vectors = 0, places = 0, labels = 0;

    HOST_DEVICE void operator()(int i) const
    {
        const std::uint32_t j = order[i];
        for (int k = 0; k < vectors; ++k) vector[k].to[i] = vector[k].from[j];
        for (int k = 0; k < places; ++k) place[k].to[i] = place[k].from[j];
        for (int k = 0; k < scalars; ++k) number[k].to[i] = number[k].from[j];
        for (int k = 0; k < labels; ++k) label[k].to[i] = label[k].from[j];
    }
};

}

FieldRegistry::Entry* FieldRegistry::find(const std::string& name)
{
    for (const auto& entry : entries_)
    {
        if (entry->info.name == name) return entry.get();
    }
    return nullptr;
}

FieldRegistry::Infos FieldRegistry::infos() const
{
    Infos infos;
    for (const auto& entry : entries_) infos.push_back(entry->info);
    return infos;
}

Columns FieldRegistry::columnsOf(bool FieldInfo::* which)
{
    Columns columns;
    for (const auto& entry : entries_)
    {
        if (entry->info.*which) std::visit([&](auto& field) { columns.push_back(valuesOf(field)); }, entry->values);
    }
    return columns;
}

void FieldRegistry::restore(const Infos& infos)
{
    entries_.resize(infos.size());
    for (std::size_t k = 0; k < infos.size(); ++k) entries_[k]->info = infos[k];
}

void FieldRegistry::resize(int n, int room)
{
    const int before = size_;
    size_ = n;
    if (n > room_) room_ = std::max(n, room);
    const auto resizeField = [&](auto& field)
    {
        field.resize(std::min(n, field.size()));        // what is cut off is not copied
        field.reserve(room_);
        field.resize(n);
        field.setZero(before);
    };
    for (const auto& entry : entries_) std::visit(resizeField, entry->values);
}

void FieldRegistry::setBirth(int first)
{
    for (const auto& entry : entries_)
    {
        auto* const values = std::get_if<Buffer<scalar>>(&entry->values);
        if (values && entry->info.atBirth != 0) values->upload(std::vector<scalar>(size_ - first, entry->info.atBirth), first);
    }
}

void FieldRegistry::reorder(const Buffer<std::uint32_t>& order)
{
    if (order.size() != size_ && order.size() < room_ - room_ / 4) room_ = order.size();
    std::vector<AnyBuffer> before;          // what is moved from, as long as it is
    ReorderFields fields;
    fields.order = order.span();
    const auto launch = [&]
    {
        if (before.empty()) return;
        forEach(order.size(), fields);
        before.clear();
        fields.scalars = fields.vectors = fields.places = fields.labels = 0;
    };
    const auto add = [&]<class T>(Buffer<T>& field, Move<T>* moves, int& n)
    {
        if (n == ReorderFields::most) launch();
        Buffer<T> sorted(room_);
        sorted.resize(order.size());
        moves[n++] = {field.span().data, sorted.span().data};
        field.swap(sorted);
        before.emplace_back(std::move(sorted));
    };
    std::vector<AnyBuffer*> vectors, numbers;
    for (const auto& entry : entries_)
    {
        const bool isNumber = std::holds_alternative<Buffer<scalar>>(entry->values) || std::holds_alternative<Buffer<std::uint32_t>>(entry->values);
        if (entry->info.sorted) (isNumber ? numbers : vectors).push_back(&entry->values);
    }
    // Of many particles a vector and a number at a time, so that little memory is needed beside the fields'.
    constexpr int many = 1 << 16;
    for (std::size_t k = 0; k < std::max(vectors.size(), numbers.size()); ++k)
    {
        if (k < vectors.size())
        {
            if (auto* of = std::get_if<Buffer<Vec3>>(vectors[k])) add(*of, fields.vector, fields.vectors);
            if (auto* of = std::get_if<Buffer<Position>>(vectors[k])) add(*of, fields.place, fields.places);
        }
        if (k < numbers.size())
        {
            if (auto* scalars = std::get_if<Buffer<scalar>>(numbers[k])) add(*scalars, fields.number, fields.scalars);
            if (auto* labels = std::get_if<Buffer<std::uint32_t>>(numbers[k])) add(*labels, fields.label, fields.labels);
        }
        if (order.size() > many) launch();
    }
    launch();
}

}
