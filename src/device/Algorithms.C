#include "device/Algorithms.H"
#include "device/Device.H"
#include "device/ExecutionPolicy.H"

#include <thrust/device_ptr.h>
#include <thrust/scan.h>
#include <thrust/sort.h>

namespace shizuku
{

void sortByKey(Buffer<std::uint32_t>& keys, Buffer<std::uint32_t>& values)
{
    const auto key = thrust::device_pointer_cast(keys.span().data);
    const auto value = thrust::device_pointer_cast(values.span().data);
    ++deviceCounters().launches;
    thrust::stable_sort_by_key(device::executionPolicy(), key, key + keys.size(), value);
}

std::uint32_t exclusiveScan(const Buffer<std::uint32_t>& in, Buffer<std::uint32_t>& out)
{
    const int n = in.size();
    out.resizeDiscarding(n + 1);
    const auto source = thrust::device_pointer_cast(in.span().data);
    const auto target = thrust::device_pointer_cast(out.span().data);
    ++deviceCounters().launches;
    device::setBytes(out.span().data, 0, sizeof(std::uint32_t));
    thrust::inclusive_scan(device::executionPolicy(), source, source + n, target + 1);
    std::uint32_t total = 0;
    device::copyToHost(&total, out.span().data + n, sizeof(total));
    return total;
}

}
