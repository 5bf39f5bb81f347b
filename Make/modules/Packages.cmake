# SPDX-License-Identifier: GPL-3.0-or-later
# What the machine offers. Required: Boost, Eigen. Optional, and then left out with a message: CUDA (the GPU
# backend), VTK and CGAL (utilities), MPI (-parallel), NCCL (between GPUs), GoogleTest and Google Benchmark (tests and benchmarks).

set(Boost_USE_STATIC_LIBS OFF)
if(POLICY CMP0167)
    cmake_policy(SET CMP0167 OLD)   # FindBoost works with and without Boost's own CMake files
endif()
find_package(Boost 1.74 REQUIRED COMPONENTS program_options)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Threads REQUIRED)

# Is a GPU here? Without one the CUDA backend is still built, its tests are not.
execute_process(COMMAND nvidia-smi -L RESULT_VARIABLE no_gpu OUTPUT_QUIET ERROR_QUIET)
if(no_gpu EQUAL 0)
    set(SHIZUKU_GPU TRUE)
else()
    set(SHIZUKU_GPU FALSE)
endif()

set(SHIZUKU_BACKENDS cpu)
option(SHIZUKU_DOUBLE "Build the CPU backend in double precision too (-precision double)" OFF)
if(SHIZUKU_DOUBLE)
    list(APPEND SHIZUKU_BACKENDS cpuDouble)
endif()
include(CheckLanguage)
if(NOT CMAKE_CUDA_COMPILER AND EXISTS /usr/local/cuda/bin/nvcc)
    set(CMAKE_CUDA_COMPILER /usr/local/cuda/bin/nvcc)
endif()
set(SHIZUKU_CUDA ON CACHE STRING "Build the CUDA backend where nvcc is found; REQUIRED: fail where it is not")
if(SHIZUKU_CUDA)
    check_language(CUDA)
endif()
if(SHIZUKU_CUDA AND CMAKE_CUDA_COMPILER)
    if(NOT DEFINED CMAKE_CUDA_ARCHITECTURES)
        # The GPU of this machine; without one, Hopper's code, and PTX that newer chips compile at start; in CI the PTX alone, since nothing runs it and
        # ptxas takes a third of the time (what only it finds, too much shared memory, a build with a GPU finds). For packages one of each generation that
        # nvcc 13 knows, Turing to Blackwell, and PTX: cards of 8.6 and 8.9 run the code of 8.0, those of 10.3 and 12.1 that of 10.0 and 12.0.
        if(NOT SHIZUKU_NATIVE)
            set(CMAKE_CUDA_ARCHITECTURES 75-real 80-real 90-real 100-real 120)
        elseif(SHIZUKU_GPU)
            set(CMAKE_CUDA_ARCHITECTURES native)
        elseif(in_ci)
            set(CMAKE_CUDA_ARCHITECTURES 90-virtual)
            set(CMAKE_CUDA_FLAGS_RELEASE "-O1 -DNDEBUG" CACHE STRING "As SHIZUKU_QUICK_FLAGS")
        else()
            set(CMAKE_CUDA_ARCHITECTURES 90)
        endif()
    endif()
    enable_language(CUDA)
    if(NOT CMAKE_CUDA20_STANDARD_COMPILE_OPTION)    # CMake 3.25 does not know that nvcc 13 has C++20
        set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION "-std=c++20")
        set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION "-std=c++20")
    endif()
    set(CMAKE_CUDA_STANDARD 20)
    set(CMAKE_CUDA_STANDARD_REQUIRED ON)
    find_package(CUDAToolkit REQUIRED)
    list(APPEND SHIZUKU_BACKENDS cuda)
    message(STATUS "CUDA backend: ${CMAKE_CUDA_COMPILER} ${CMAKE_CUDA_COMPILER_VERSION}, architectures ${CMAKE_CUDA_ARCHITECTURES}")
elseif(SHIZUKU_CUDA STREQUAL REQUIRED)
    message(FATAL_ERROR "CUDA backend: SHIZUKU_CUDA is REQUIRED, but there is no nvcc, neither on the PATH nor in /usr/local/cuda/bin")
else()
    message(STATUS "CUDA backend: left out, no nvcc")
endif()

# Thrust for the CPU backend: the CUDA toolkit's CCCL where it is, else the system's headers.
find_path(SHIZUKU_CCCL_INCLUDE thrust/version.h
    HINTS ${CUDAToolkit_INCLUDE_DIRS} /usr/local/cuda/include PATH_SUFFIXES cccl)
if(NOT SHIZUKU_CCCL_INCLUDE)
    message(FATAL_ERROR "Thrust's headers are missing: install libthrust-dev and libcub-dev, or the CUDA toolkit")
endif()

find_package(CGAL QUIET)
find_package(VTK 9 QUIET COMPONENTS
    CommonCore CommonDataModel IOXML FiltersCore FiltersGeometry FiltersSources RenderingCore
    RenderingOpenGL2 RenderingFreeType RenderingAnnotation ImagingCore IOImage IOGeometry IOPLY png)
find_package(GTest QUIET)
find_package(benchmark QUIET)
find_package(MPI QUIET COMPONENTS CXX)
if(cuda IN_LIST SHIZUKU_BACKENDS)
    find_path(NCCL_INCLUDE nccl.h HINTS ${CUDAToolkit_INCLUDE_DIRS} /usr/local/cuda/include)
    find_library(NCCL_LIBRARY nccl HINTS ${CUDAToolkit_LIBRARY_DIR} /usr/local/cuda/lib /usr/local/cuda/lib64)
endif()
if(NCCL_INCLUDE AND NCCL_LIBRARY)
    set(NCCL_FOUND TRUE)
endif()
foreach(package CGAL VTK MPI NCCL GTest benchmark)
    if(${package}_FOUND)
        message(STATUS "${package}: found")
    else()
        message(STATUS "${package}: not found, what needs it is left out")
    endif()
endforeach()
