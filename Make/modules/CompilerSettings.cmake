# SPDX-License-Identifier: GPL-3.0-or-later
# Language level, warnings, output folders and the name of the build.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, RelWithDebInfo or Debug" FORCE)
endif()

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib)
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)
set(CMAKE_BUILD_RPATH "$ORIGIN/../lib")
set(CMAKE_INSTALL_RPATH "$ORIGIN/../lib")

option(SHIZUKU_NATIVE "Use every instruction of the processor that builds; OFF: code for any x86-64-v2, and for v3 where the processor has it" ON)
set(in_ci OFF)
if(DEFINED ENV{CI})
    set(in_ci ON)
endif()
option(SHIZUKU_WERROR "Refuse what a compiler warns of in host code" ${in_ci})
set(SHIZUKU_SANITIZE OFF CACHE STRING "Sanitizers to build with, as -fsanitize takes them; ON: address,undefined")

# Host code is compiled with these; errno and trapping arithmetic are never asked for, and fused
# multiply-add is what the GPU does too. NaN and infinity keep their meaning (no -ffast-math).
set(SHIZUKU_HOST_FLAGS -Wall -Wextra -Wno-unknown-pragmas -fno-math-errno -fno-trapping-math -ffp-contract=fast)
if(SHIZUKU_NATIVE)
    list(APPEND SHIZUKU_HOST_FLAGS -march=native)
else()
    if(CMAKE_SYSTEM_PROCESSOR STREQUAL x86_64)
        list(APPEND SHIZUKU_HOST_FLAGS -march=x86-64-v2)
    endif()
endif()
list(APPEND SHIZUKU_HOST_FLAGS -Wno-psabi)          # eight numbers at once where the processor has fewer: nobody else's interface
set(SHIZUKU_TEST_FLAGS ${SHIZUKU_HOST_FLAGS} -O1 -Wno-subobject-linkage)        # short runs: quick to compile counts. What tests are warned of is no error; several are compiled as one
if(SHIZUKU_WERROR)
    list(APPEND SHIZUKU_HOST_FLAGS -Werror -Wno-error=invalid-pch -Wno-error=restrict -Wno-error=stringop-overflow -Wno-error=array-bounds)        # g++ 12 is wrong about strings (its bug 105651)
    list(APPEND SHIZUKU_HOST_FLAGS -Wno-error=uninitialized -Wno-error=maybe-uninitialized)        # and about its own intrinsics of AVX-512 (its bug 105593)
endif()
set(SHIZUKU_QUICK_FLAGS $<$<BOOL:${in_ci}>:-O1>)        # of programs and host libraries: CI runs them briefly, and compiles them in two thirds of the time
set(SHIZUKU_KERNEL_OPTIMISATION $<IF:$<BOOL:${in_ci}>,-O2,-O3>)        # of the CPU's backends: a fifth less to compile
if(SHIZUKU_SANITIZE)
    set(SHIZUKU_KERNEL_OPTIMISATION -O1)    # with sanitizers -O3 takes the compiler three times as long
    set(sanitizers ${SHIZUKU_SANITIZE})
    if(sanitizers STREQUAL ON)
        set(sanitizers address,undefined)
    endif()
    add_compile_options(-fsanitize=${sanitizers} -fno-omit-frame-pointer)
    add_link_options(-fsanitize=${sanitizers})
endif()

execute_process(
    COMMAND git -C ${CMAKE_CURRENT_SOURCE_DIR} describe --always --dirty
    OUTPUT_VARIABLE SHIZUKU_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT SHIZUKU_COMMIT)
    set(SHIZUKU_COMMIT unknown)
endif()
