// SPDX-License-Identifier: GPL-3.0-or-later
#include "device/HostThreads.H"

#include <exception>

namespace shizuku
{

void forEachPart(std::size_t parts, const std::function<void(std::size_t)>& work)
{
    std::exception_ptr failure;
    std::size_t failed = parts;             // the first part that failed
    #pragma omp parallel for schedule(dynamic)
    for (std::size_t part = 0; part < parts; ++part)
    {
        try
        {
            work(part);
        }
        catch (...)
        {
            #pragma omp critical(failureOfPart)
            if (part < failed)
            {
                failed = part;
                failure = std::current_exception();
            }
        }
    }
    if (failure) std::rethrow_exception(failure);
}

}
