// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/HiddenValues.H"

#include "device/ForEach.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// No number, and far away as a place.
template<class T>
struct Poison
{
    Span<T> values;
    int first;

    HOST_DEVICE void operator()(int k) const
    {
        constexpr bool single = sizeof(scalar) == 4;
        constexpr Word noNumber = single ? Word(0x7fc00000) : Word(std::int64_t(0x7ff80000) << 32 * !single);
        if constexpr (std::is_same_v<T, scalar>) values[first + k] = numberOf(noNumber);
        else if constexpr (std::is_same_v<T, Vec3>) values[first + k] = {numberOf(noNumber), numberOf(noNumber), numberOf(noNumber), numberOf(noNumber)};
        else values[first + k] = {noNumber, noNumber, noNumber, noNumber};
    }
};

template<class T>
struct SwapWith
{
    Span<T> values;
    int first;
    Span<T> others;

    HOST_DEVICE void operator()(int k) const
    {
        const T value = values[first + k];
        values[first + k] = others[k];
        others[k] = value;
    }
};

// act(entry, values) for the fields of numbers that have ghosts, but for those.
template<class Act>
void forEachOther(const FieldRegistry& fields, int first, const Columns& but, const Act& act)
{
    for (const auto& field : fields.entries())
    {
        std::visit
        (
            [&]<class T>(Buffer<T>& values)
            {
                if constexpr (!std::is_same_v<T, std::uint32_t>)
                {
                    const auto* begin = reinterpret_cast<std::byte*>(values.span().data);
                    const auto isThis = [&](const Column& column) { return column.values >= begin && column.values < begin + sizeof(T); };
                    if (values.size() > first && std::none_of(but.begin(), but.end(), isThis)) act(*field, values);
                }
            },
            field->values
        );
    }
}

}

void poison(const FieldRegistry& fields, int first, const Columns& but, bool exchangedStay)
{
    forEachOther(fields, first, but, [&]<class T>(const FieldRegistry::Entry& field, Buffer<T>& values)
    {
        if (!exchangedStay || !field.info.exchanged) forEach(values.size() - first, Poison<T>{values.span(), first});
    });
}

HiddenValues::HiddenValues(const FieldRegistry& fields, int first, const Columns& but) : first_(first)
{
    forEachOther(fields, first, but, [&]<class T>(FieldRegistry::Entry& field, Buffer<T>& values)
    {
        Buffer<T> others(values.size() - first);
        forEach(others.size(), Poison<T>{others.span(), 0});
        forEach(others.size(), SwapWith<T>{values.span(), first, others.span()});
        hidden_.emplace_back(&field, std::move(others));
    });
}

HiddenValues::~HiddenValues()
{
    for (auto& [field, kept] : hidden_)
    {
        std::visit
        (
            [&]<class T>(Buffer<T>& others)
            {
                if constexpr (!std::is_same_v<T, std::uint32_t>)
                {
                    forEach(others.size(), SwapWith<T>{std::get<Buffer<T>>(field->values).span(), first_, others.span()});
                }
            },
            kept
        );
    }
}

}
