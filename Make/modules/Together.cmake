# SPDX-License-Identifier: GPL-3.0-or-later
# Sources compiled several at a time: most of what a compiler takes for one are the headers. CMake's own unity builds know no CUDA
# before 3.31, and no names that each of their sources has.
option(SHIZUKU_UNITY "Compile up to eight sources of a list as one; OFF: each by itself, which shows whether it includes what it uses" ON)

# Replaces the sources in a list of more than one by files that include up to eight of them each, in the list's order. `registered`, by which models enter
# their tables, is another name in each; other names in unnamed namespaces must differ within eight. ALONE: what is compiled by itself.
#     shizuku_together(sources core ALONE a.C)
function(shizuku_together list name)
    list(LENGTH ${list} length)
    if(NOT SHIZUKU_UNITY OR length LESS 2)
        return()
    endif()
    cmake_parse_arguments(ARG "" "" "ALONE" ${ARGN})
    set(kept "")
    set(text "")
    set(count 0)
    set(batch 0)
    foreach(source IN LISTS ${list})
        if(source IN_LIST ARG_ALONE)
            list(APPEND kept ${source})
            continue()
        endif()
        string(APPEND text "#define registered registered${count}\n#include \"${source}\"\n#undef registered\n")
        math(EXPR count "${count} + 1")
        if(count EQUAL 8)
            shizuku_write_batch()
        endif()
    endforeach()
    if(count GREATER 0)
        shizuku_write_batch()
    endif()
    set(${list} ${kept} PARENT_SCOPE)
endfunction()

macro(shizuku_write_batch)      # of shizuku_together() alone
    math(EXPR batch "${batch} + 1")
    set(file ${CMAKE_BINARY_DIR}/together/${name}${batch}.C)
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
    list(APPEND kept ${file})
    set(text "")
    set(count 0)
endmacro()
