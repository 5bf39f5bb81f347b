# SPDX-License-Identifier: GPL-3.0-or-later
# The few kinds of targets that the project has.

# A host library (shared: models and tables register themselves when it is loaded).
#     shizuku_library(shizukuCore SOURCES a.C b.C LINK Boost::program_options)
# ALONE: those of its sources that are compiled by themselves.
function(shizuku_library name)
    cmake_parse_arguments(ARG "" "" "SOURCES;ALONE;LINK" ${ARGN})
    list(TRANSFORM ARG_SOURCES PREPEND ${PROJECT_SOURCE_DIR}/src/)
    list(TRANSFORM ARG_ALONE PREPEND ${PROJECT_SOURCE_DIR}/src/)
    shizuku_together(ARG_SOURCES ${name} ALONE ${ARG_ALONE})
    add_library(${name} SHARED ${ARG_SOURCES})
    set_source_files_properties(${ARG_SOURCES} PROPERTIES LANGUAGE CXX)
    target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
    target_compile_options(${name} PRIVATE ${SHIZUKU_HOST_FLAGS} ${SHIZUKU_QUICK_FLAGS})
    target_link_libraries(${name} PUBLIC ${ARG_LINK})
    set_target_properties(${name} PROPERTIES DEFINE_SYMBOL "")         # flags as of the other libraries, whose headers are compiled once
    if(NOT TARGET shizukuCore OR name STREQUAL shizukuCore)
        target_precompile_headers(${name} PRIVATE ${SHIZUKU_PRECOMPILED})
    elseif(NOT ARG_LINK MATCHES "CGAL|VTK")                             # which bring flags of their own
        target_precompile_headers(${name} REUSE_FROM shizukuCore)
    endif()
endfunction()

# A host application, found in applications/<path>/<name>/.
#     shizuku_application(utilities/preProcessing/fillLiquid SOURCES fillLiquid.C LINK shizukuGeometry)
function(shizuku_application path)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
    get_filename_component(name ${path} NAME)
    list(TRANSFORM ARG_SOURCES PREPEND ${PROJECT_SOURCE_DIR}/applications/${path}/)
    shizuku_together(ARG_SOURCES ${name})
    add_executable(${name} ${ARG_SOURCES})
    set_source_files_properties(${ARG_SOURCES} PROPERTIES LANGUAGE CXX)
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/applications/${path})
    target_compile_options(${name} PRIVATE ${SHIZUKU_HOST_FLAGS} ${SHIZUKU_QUICK_FLAGS})
    target_link_libraries(${name} PRIVATE shizukuCore ${ARG_LINK})
    if(NOT ARG_LINK MATCHES "Sampling|Vtk")                             # which bring flags of their own
        target_compile_options(${name} PRIVATE -fPIC)                   # as shizukuCore, whose headers it takes
        target_precompile_headers(${name} REUSE_FROM shizukuCore)
    endif()
endfunction()

# The executable of an application that runs on a device: a thin launcher that opens lib<name>-<backend>.so, the module
# for the device that -device asks for (see Backend.cmake). <name>.C defines  extern "C" int runOnDevice(int argc, char** argv).
function(shizuku_device_launcher name)
    add_executable(${name} ${PROJECT_SOURCE_DIR}/src/device/launcher/launcher.C)
    set_source_files_properties(${PROJECT_SOURCE_DIR}/src/device/launcher/launcher.C PROPERTIES LANGUAGE CXX)
    target_compile_definitions(${name} PRIVATE SHIZUKU_APPLICATION="${name}")
    target_compile_options(${name} PRIVATE ${SHIZUKU_HOST_FLAGS})
    target_link_libraries(${name} PRIVATE shizukuCore ${CMAKE_DL_LIBS})
endfunction()

# All test programs; none is part of the default target.
add_custom_target(tests)

# A GoogleTest program below tests/. Nothing happens where GoogleTest is absent. Those of its tests that may skip themselves
# (MAY_SKIP, a filter of GoogleTest's) are a test of CTest's own, <name>-maySkip, which is then skipped and not passed.
#     shizuku_test(unit/core/TestDictionary SOURCES TestDictionary.C LINK shizukuCore)
function(shizuku_test path)
    if(NOT GTest_FOUND)
        return()
    endif()
    cmake_parse_arguments(ARG "" "MAY_SKIP" "SOURCES;LINK;LABELS" ${ARGN})
    get_filename_component(name ${path} NAME)
    get_filename_component(folder ${path} DIRECTORY)
    list(TRANSFORM ARG_SOURCES PREPEND ${PROJECT_SOURCE_DIR}/tests/${folder}/)
    shizuku_together(ARG_SOURCES ${name})
    add_executable(${name} EXCLUDE_FROM_ALL ${ARG_SOURCES})
    add_dependencies(tests ${name})
    set_source_files_properties(${ARG_SOURCES} PROPERTIES LANGUAGE CXX)
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
    target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
    target_compile_options(${name} PRIVATE ${SHIZUKU_TEST_FLAGS})
    target_link_libraries(${name} PRIVATE ${ARG_LINK} GTest::gtest_main)
    target_precompile_headers(${name} REUSE_FROM testSupport)
    set(tests ${name})
    if(ARG_MAY_SKIP)
        add_test(NAME ${name} COMMAND ${name} --gtest_filter=-${ARG_MAY_SKIP})
        add_test(NAME ${name}-maySkip COMMAND ${name} --gtest_filter=${ARG_MAY_SKIP})
        set_tests_properties(${name}-maySkip PROPERTIES
            SKIP_REGULAR_EXPRESSION "SKIPPED" FAIL_REGULAR_EXPRESSION "Running 0 tests")
        list(APPEND tests ${name}-maySkip)
    else()
        add_test(NAME ${name} COMMAND ${name})
    endif()
    set_tests_properties(${tests} PROPERTIES
        LABELS "${ARG_LABELS}" ENVIRONMENT "SHIZUKU_DIR=${PROJECT_SOURCE_DIR};SHIZUKU_BUILD=${CMAKE_BINARY_DIR}")
endfunction()
