# Builds the device part of the program for one backend: the library shizukuDevice-<backend>, a module for each
# device application and the tests. Each backend folder includes this once, in its own directory scope, since
# the language of a source file is a property of the directory.
#     shizuku_backend(cuda LANGUAGE CUDA TESTS ${SHIZUKU_GPU} FLAGS ... SOURCES device/cuda/Device.C LINK CUDA::cudart)
# TESTS: TRUE, FALSE, or the paths of some below tests/unit/.
# One that is not among SHIZUKU_BACKENDS is left out of `all`; its targets can be asked for.
include(${PROJECT_SOURCE_DIR}/Make/sources/device.cmake)
include(${PROJECT_SOURCE_DIR}/Make/sources/deviceApplications.cmake)
include(${PROJECT_SOURCE_DIR}/Make/sources/deviceTests.cmake)

function(shizuku_backend backend)
    cmake_parse_arguments(ARG "" "LANGUAGE" "TESTS;FLAGS;INCLUDE;SOURCES;LINK" ${ARGN})

    set(library shizukuDevice-${backend})
    set(sources ${ARG_SOURCES} ${SHIZUKU_DEVICE_SOURCES})
    list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/src/)
    add_library(${library} SHARED ${sources})
    set_source_files_properties(${sources} PROPERTIES LANGUAGE ${ARG_LANGUAGE})
    target_include_directories(${library} PUBLIC ${PROJECT_SOURCE_DIR}/src)
    target_include_directories(${library} SYSTEM PRIVATE ${ARG_INCLUDE})
    target_compile_options(${library} PRIVATE ${ARG_FLAGS})
    target_link_libraries(${library} PUBLIC shizukuCore shizukuGeometry ${ARG_LINK})
    if(ARG_LANGUAGE STREQUAL CXX)
        target_precompile_headers(${library} PRIVATE ${SHIZUKU_PRECOMPILED})
    endif()

    foreach(path IN LISTS SHIZUKU_DEVICE_APPLICATIONS)
        get_filename_component(name ${path} NAME)
        set(sources ${${name}_SOURCES})
        list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/applications/${path}/)
        add_library(${name}-${backend} MODULE ${sources})
        set_source_files_properties(${sources} PROPERTIES LANGUAGE ${ARG_LANGUAGE})
        target_include_directories(${name}-${backend} PRIVATE
            ${PROJECT_SOURCE_DIR}/applications/${path} ${PROJECT_SOURCE_DIR}/applications)
        target_compile_options(${name}-${backend} PRIVATE ${ARG_FLAGS})
        target_link_libraries(${name}-${backend} PRIVATE ${library} ${${name}_LINK})
        if(${name}_PLUGINS AND TARGET ${${name}_PLUGINS})
            # What registers itself is needed though nothing is called by name; only the linker sees it.
            target_link_libraries(${name}-${backend} PRIVATE
                -Wl,--no-as-needed $<LINK_ONLY:${${name}_PLUGINS}> -Wl,--as-needed)
        endif()
        if(NOT TARGET ${name})
            shizuku_device_launcher(${name})
        endif()
        if(backend IN_LIST SHIZUKU_BACKENDS)
            add_dependencies(${name} ${name}-${backend})
        endif()
    endforeach()

    if(GTest_FOUND AND SHIZUKU_DEVICE_TESTS AND ARG_TESTS)
        if(ARG_TESTS MATCHES "[.]C$")
            set(sources ${ARG_TESTS})
        else()
            set(sources ${SHIZUKU_DEVICE_TESTS})
        endif()
        list(TRANSFORM sources PREPEND unit/)
        list(APPEND sources ${SHIZUKU_DEVICE_TEST_SUPPORT})
        list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/tests/)
        set(name TestDevice-${backend})
        add_executable(${name} EXCLUDE_FROM_ALL ${sources})
        add_dependencies(tests ${name})
        set_source_files_properties(${sources} PROPERTIES LANGUAGE ${ARG_LANGUAGE})
        set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
        target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
        target_compile_options(${name} PRIVATE ${ARG_FLAGS} -O1)     # short runs: quick to compile counts
        target_link_libraries(${name} PRIVATE ${library} GTest::gtest)
        if(ARG_LANGUAGE STREQUAL CXX)
            target_precompile_headers(${name} PRIVATE ${SHIZUKU_PRECOMPILED} <gtest/gtest.h>)
        endif()
        add_test(NAME ${name} COMMAND ${name})
        # 77: no GPU, see tests/support/DeviceMain.C. The loops are short: threads that wait shall not spin on a busy machine.
        set_tests_properties(${name} PROPERTIES LABELS "unit;${backend}" SKIP_RETURN_CODE 77
            ENVIRONMENT "SHIZUKU_DIR=${PROJECT_SOURCE_DIR};SHIZUKU_BUILD=${CMAKE_BINARY_DIR};OMP_WAIT_POLICY=passive")
    endif()
endfunction()
