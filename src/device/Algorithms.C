#include "device/Algorithms.H"

#include "core/messages/Error.H"
#include "device/Device.H"
#include "device/ForEach.H"
#include "device/Profile.H"

#ifdef __CUDACC__
#include "device/cuda/Primitives.H"
#else
#include "device/openmp/Primitives.H"
#endif

#include <thrust/device_ptr.h>
#include <thrust/functional.h>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/transform_iterator.h>
#include <thrust/scan.h>

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

struct PlaceChosen
{
    Span<const std::uint8_t> chosen;
    Span<const std::uint32_t> before;
    Span<std::uint32_t> indices;

    HOST_DEVICE void operator()(int i) const
    {
        if (chosen[i]) indices[int(before[i])] = std::uint32_t(i);
    }
};

template<class T, class Sum>
T scan(const Buffer<T>& in, Buffer<T>& out, Sum sum)
{
    const int n = in.size();
    out.resizeDiscarding(n + 1);
    const auto source = thrust::device_pointer_cast(in.span().data);
    const auto target = thrust::device_pointer_cast(out.span().data);
    ++deviceCounters().launches;
    const device::KernelTimer timer("scan");
    device::setBytes(out.span().data, 0, sizeof(T));
    thrust::inclusive_scan(device::executionPolicy(), source, source + n, target + 1, sum);
    T total = 0;
    device::copyToHost(&total, out.span().data + n, sizeof(total));
    return total;
}

}

void sort(Buffer<std::uint64_t>& keys)
{
    ++deviceCounters().launches;
    const device::KernelTimer timer("sort");
    device::sortKeys(keys.span().data, keys.size());
}

void select(const Buffer<std::uint8_t>& chosen, Selection& selection)
{
    const int n = chosen.size();
    selection.indices.resizeDiscarding(n);
    selection.before.resizeDiscarding(n + 1);
    const auto counts = thrust::make_transform_iterator(thrust::counting_iterator<int>(0), Chosen{chosen.span()});
    {
        ++deviceCounters().launches;
        const device::KernelTimer timer("select");
        const auto target = thrust::device_pointer_cast(selection.before.span().data);
        thrust::exclusive_scan(device::executionPolicy(), counts, counts + (n + 1), target);
    }
    forEach(n, PlaceChosen{chosen.span(), selection.before.span(), selection.indices.span()});
}

std::uint32_t exclusiveScan(const Buffer<std::uint32_t>& in, Buffer<std::uint32_t>& out, const char* list)
{
    const std::uint32_t total = scan(in, out, SaturatingSum{});
    constexpr std::uint32_t most = 0x7fffffffu;
    if (total > most)
    {
        throw FatalError
        (
            "Too many " + std::string(list) + ": " + (total == 0xffffffffu ? "2^32 or more" : std::to_string(total))
          + ", and a list holds at most " + std::to_string(most)
          + ".\n    Use fewer particles, or a kernel with a shorter support in system/solution."
        );
    }
    return total;
}

void sumBefore(Buffer<std::uint32_t>& numbers)
{
    ++deviceCounters().launches;
    const device::KernelTimer timer("scan");
    const auto first = thrust::device_pointer_cast(numbers.span().data);
    thrust::exclusive_scan(device::executionPolicy(), first, first + numbers.size(), first);
}

std::uint64_t exclusiveScan(const Buffer<std::uint64_t>& in, Buffer<std::uint64_t>& out)
{
    return scan(in, out, thrust::plus<std::uint64_t>());
}

}
