// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/Algorithms.H"

#include "core/messages/Error.H"
#include "device/Device.H"
#include "device/ForEach.H"
#include "device/HostBuffer.H"
#include "device/Profile.H"

#ifdef LANES_SHARE
#include "device/cuda/Primitives.H"
#else
#include "device/openmp/Primitives.H"
#endif

#include <thrust/functional.h>

#include <string>

namespace shizuku
{

namespace
{

// Stays at the largest number instead of starting anew at zero.
struct SaturatingSum
{
    HOST_DEVICE std::uint32_t operator()(std::uint32_t a, std::uint32_t b) const
    {
        const std::uint32_t sum = a + b;
        return sum < a ? 0xffffffffu : sum;
    }
};

// Of an index: whether it is chosen. Of the end: not.
struct Chosen
{
    Span<const std::uint8_t> chosen;

    HOST_DEVICE std::uint32_t operator()(int i) const { return i < chosen.size && chosen[i] != 0; }
};

// Of an index: its value. Of the end: nothing.
template<class T>
struct ValueOf
{
    Span<const T> values;

    HOST_DEVICE T operator()(int i) const { return i < values.size ? values[i] : T{}; }
};

// Takes the sum before each, and brings the total, which is the last one, to the host's memory where it is wanted.
template<class T>
struct KeepSums
{
    Span<T> sums;
    T* last = nullptr;

    HOST_DEVICE void operator()(int i, T sum) const
    {
        sums[i] = sum;
        if (last && i == sums.size - 1) *last = sum;
    }
};

// Of the end too: how many all are.
struct PlaceChosen
{
    Span<const std::uint8_t> chosen;
    Span<std::uint32_t> before, indices;
    Readback::Post all;

    HOST_DEVICE void operator()(int i, std::uint32_t place) const
    {
        const std::uint32_t room = std::uint32_t(indices.size);
        before[i] = place < room ? place : room;
        if (place < room && i < chosen.size && chosen[i]) indices[int(place)] = std::uint32_t(i);
        if (i == chosen.size) all(place);
    }
};

// The sums before each, and the total behind them.
template<class T, class Add>
T scan(const Buffer<T>& in, Buffer<T>& out, Add add)
{
    static HostBuffer<T>& total = *new HostBuffer<T>;           // to the end of the process
    total.resizeDiscarding(1);
    const int n = in.size() + 1;
    out.resizeDiscarding(n);
    {
        const device::CountedKernel kernel("scan");
        device::scan(ValueOf<T>{in.span()}, n, out.span().data, KeepSums<T>{out.span(), total.data()}, add);
    }
    synchronize();
    return *total.data();
}

}

void sort(Buffer<std::uint64_t>& keys)
{
    const device::CountedKernel kernel("sort");
    device::sortKeys(keys.span().data, keys.size());
}

void select(const Buffer<std::uint8_t>& chosen, Selection& selection)
{
    static Readback& unwanted = *new Readback;                  // to the end of the process
    select(chosen, selection, chosen.size(), unwanted);
}

void select(const Buffer<std::uint8_t>& chosen, Selection& selection, int room, Readback& all)
{
    const int n = chosen.size();
    if (selection.indices.size() != room)
    {
        selection.indices.discard();
        selection.indices.resize(room);
    }
    selection.before.resizeDiscarding(n + 1);
    const device::CountedKernel kernel("select");
    const PlaceChosen place{chosen.span(), selection.before.span(), selection.indices.span(), all.ask()};
    device::scan(Chosen{chosen.span()}, n + 1, selection.before.span().data, place, thrust::plus<std::uint32_t>{});
}

int countOf(std::uint64_t total, const char* list)
{
    constexpr std::uint64_t most = 0x7fffffffu, saturated = 0xffffffffu;
    if (total > most)
    {
        throw FatalError
        (
            "Too many " + std::string(list) + ": " + (total >= saturated ? "2^32 or more" : std::to_string(total))
          + ", and a list holds at most " + std::to_string(most)
          + ".\n    Use fewer particles, or a kernel with a shorter support in system/solution."
        );
    }
    return int(total);
}

std::uint32_t exclusiveScan(const Buffer<std::uint32_t>& in, Buffer<std::uint32_t>& out, const char* list)
{
    return std::uint32_t(countOf(scan(in, out, SaturatingSum{}), list));
}

void sumBefore(Buffer<std::uint32_t>& numbers)
{
    const device::CountedKernel kernel("scan");
    using Number = std::uint32_t;
    const Span<Number> all = numbers.span();
    device::scan(ValueOf<Number>{all}, all.size, all.data, KeepSums<Number>{all}, thrust::plus<Number>{});
}

std::uint64_t exclusiveScan(const Buffer<std::uint64_t>& in, Buffer<std::uint64_t>& out)
{
    return scan(in, out, thrust::plus<std::uint64_t>{});
}

}
