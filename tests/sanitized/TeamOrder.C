// SPDX-License-Identifier: GPL-3.0-or-later
// Tells TSan what g++'s OpenMP orders. Its library, libgomp, is built without TSan, which cannot see that the threads of a region begin behind what stands
// before it, that what follows waits for them, and what a barrier is. These functions stand before the library's own of the same names, and call them. Who
// takes which share of a loop orders nothing. Itself built without TSan.

#include <dlfcn.h>

extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);

namespace
{

using Body = void (*)(void*);

struct Region
{
    Body body;
    void* data;
    char begun = 0, ended = 0;      // their addresses stand for what is ordered
};

void runBody(void* of)
{
    Region& region = *static_cast<Region*>(of);
    __tsan_acquire(&region.begun);
    region.body(region.data);
    __tsan_release(&region.ended);
}

template<class Function>
Function* ofLibrary(const char* name) { return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name)); }

}

extern "C" void GOMP_parallel(Body body, void* data, unsigned threads, unsigned flags)
{
    static const auto own = ofLibrary<void(Body, void*, unsigned, unsigned)>("GOMP_parallel");
    Region region{body, data};
    __tsan_release(&region.begun);
    own(runBody, &region, threads, flags);
    __tsan_acquire(&region.ended);
}

extern "C" void GOMP_barrier()
{
    static const auto own = ofLibrary<void()>("GOMP_barrier");
    static char reached = 0;
    __tsan_release(&reached);
    own();
    __tsan_acquire(&reached);
}
