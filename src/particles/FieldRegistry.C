#include "particles/FieldRegistry.H"

#include "device/ForEach.H"

namespace shizuku
{

namespace
{

template<class T>
struct Gather
{
    Span<const std::uint32_t> order;
    Span<const T> from;
    Span<T> to;

    HOST_DEVICE void operator()(int i) const { to[i] = from[order[i]]; }
};

template<class T>
void gather(Buffer<T>& field, Buffer<T>& scratch, const Buffer<std::uint32_t>& order)
{
    scratch.resizeDiscarding(field.size());
    forEach(order.size(), Gather<T>{order.span(), field.span(), scratch.span()});
    field.swap(scratch);
}

}

FieldRegistry::Entry* FieldRegistry::find(const std::string& name)
{
    for (const auto& entry : entries_)
    {
        if (entry->info.name == name) return entry.get();
    }
    return nullptr;
}

void FieldRegistry::resize(int n)
{
    size_ = n;
    for (const auto& entry : entries_)
    {
        std::visit([n](auto& field) { field.resize(n); }, entry->values);
    }
}

void FieldRegistry::reorder(const Buffer<std::uint32_t>& order)
{
    for (const auto& entry : entries_)
    {
        if (!entry->info.sorted) continue;
        if (auto* scalars = std::get_if<Buffer<float>>(&entry->values)) gather(*scalars, scalarScratch_, order);
        if (auto* vectors = std::get_if<Buffer<Vec3>>(&entry->values)) gather(*vectors, vectorScratch_, order);
        if (auto* labels = std::get_if<Buffer<std::uint32_t>>(&entry->values)) gather(*labels, labelScratch_, order);
    }
}

}
