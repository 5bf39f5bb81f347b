#include "particles/FieldRegistry.H"

#include "device/Gather.H"

namespace shizuku
{

namespace
{

template<class T>
void reorderBy(const Buffer<std::uint32_t>& order, Buffer<T>& field, Buffer<T>& scratch)
{
    gather(field, order, scratch);
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
    const int before = size_;
    size_ = n;
    const auto resizeField = [&](auto& field)
    {
        field.resize(n);
        field.setZero(before);
    };
    for (const auto& entry : entries_) std::visit(resizeField, entry->values);
}

void FieldRegistry::reorder(const Buffer<std::uint32_t>& order)
{
    for (const auto& entry : entries_)
    {
        if (!entry->info.sorted) continue;
        if (auto* scalars = std::get_if<Buffer<float>>(&entry->values)) reorderBy(order, *scalars, scalarScratch_);
        if (auto* vectors = std::get_if<Buffer<Vec3>>(&entry->values)) reorderBy(order, *vectors, vectorScratch_);
        if (auto* labels = std::get_if<Buffer<std::uint32_t>>(&entry->values)) reorderBy(order, *labels, labelScratch_);
    }
}

}
