# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install and cpack. What is installed lies in one folder, which may be moved: bin, lib, etc, share, tutorials. Packages put it into
# /opt/shizuku: shizuku with the CPU's backends, shizuku-cuda with the GPU's, shizuku-mpi with what -parallel opens. Included last: it looks at all targets.

set(components shizuku)

# Of the default build; what is built on demand (tests) is not installed.
set(folders ${SHIZUKU_BACKENDS})
list(TRANSFORM folders PREPEND backends/)
list(APPEND folders core geometry reference study advice vtk liveView parallel applications)
list(TRANSFORM folders PREPEND ${PROJECT_SOURCE_DIR}/Make/)
foreach(folder IN LISTS folders)
    get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target IN LISTS targets)
        get_target_property(type ${target} TYPE)
        get_target_property(on_demand ${target} EXCLUDE_FROM_ALL)
        if(on_demand OR NOT type MATCHES "^(SHARED_LIBRARY|MODULE_LIBRARY|EXECUTABLE)$")
            continue()
        endif()
        set(component shizuku)
        if(target MATCHES "(-cuda|Nccl)$")
            set(component cuda)
            list(APPEND components cuda)
        elseif(target STREQUAL shizukuMpi)
            set(component mpi)
            list(APPEND components mpi)
        endif()
        get_target_property(destination ${target} SHIZUKU_LIBRARY_FOLDER)       # below lib; see backends/cpu
        if(NOT destination)
            set(destination .)
        endif()
        install(TARGETS ${target}
            RUNTIME DESTINATION bin COMPONENT ${component}
            LIBRARY DESTINATION lib/${destination} COMPONENT ${component})
    endforeach()
endforeach()

install(PROGRAMS bin/RunFunctions bin/plotCase bin/runTutorials bin/makeFilms DESTINATION bin COMPONENT shizuku)
install(FILES etc/bashrc DESTINATION etc COMPONENT shizuku)
install(DIRECTORY etc/completion DESTINATION etc COMPONENT shizuku)
install(DIRECTORY etc/caseDefaults etc/advice DESTINATION etc COMPONENT shizuku)
install(DIRECTORY tutorials DESTINATION . COMPONENT shizuku USE_SOURCE_PERMISSIONS
    # What a tutorial computes when it is run in its place (.gitignore).
    REGEX "/tutorials/[^/]*/(log\\..*|[0-9][^/]*|postProcessing|VTK|sweep|theta[^/]*|present|previous|striped|painted|drops[0-9][^/]*|[^/]*\\.(png|csv))$" EXCLUDE
    REGEX "/constant/solid$" EXCLUDE
    REGEX "/(stlSurface|rainOnStreet)/constant/triSurface$" EXCLUDE)
install(DIRECTORY python DESTINATION . COMPONENT shizuku PATTERN tests EXCLUDE PATTERN __pycache__ EXCLUDE PATTERN build EXCLUDE PATTERN *.egg-info EXCLUDE)
install(FILES LICENSE README.md CHANGELOG.md CITATION.cff DESTINATION share/doc/shizuku COMPONENT shizuku)
install(FILES doc/glossary.md DESTINATION share/doc/shizuku COMPONENT shizuku)
install(DIRECTORY doc/guide doc/theory-guide doc/pictures DESTINATION share/doc/shizuku COMPONENT shizuku)

# A man page a program, out of its -help.
get_property(programs DIRECTORY ${PROJECT_SOURCE_DIR}/Make/applications PROPERTY BUILDSYSTEM_TARGETS)
include(${PROJECT_SOURCE_DIR}/Make/sources/deviceApplications.cmake)
foreach(path IN LISTS SHIZUKU_DEVICE_APPLICATIONS)
    get_filename_component(name ${path} NAME)
    list(APPEND programs ${name})
endforeach()
foreach(program IN LISTS programs)
    set(page ${CMAKE_BINARY_DIR}/share/man/man1/${program}.1)
    add_custom_command(OUTPUT ${page}
        COMMAND ${PROJECT_SOURCE_DIR}/doc/makeManPage $<TARGET_FILE:${program}> ${PROJECT_VERSION} ${page}
        DEPENDS ${program} ${PROJECT_SOURCE_DIR}/doc/makeManPage)
    list(APPEND pages ${page})
endforeach()
add_custom_target(manPages ALL DEPENDS ${pages})
install(FILES ${pages} DESTINATION share/man/man1 COMPONENT shizuku)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR Shizuku)
set(CPACK_PACKAGE_CONTACT "The Shizuku authors <shizuku@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /opt/shizuku)
list(REMOVE_DUPLICATES components)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib)
set(CPACK_DEBIAN_SHIZUKU_PACKAGE_NAME shizuku)
set(CPACK_DEBIAN_SHIZUKU_PACKAGE_RECOMMENDS "gnuplot-nox, xvfb, xauth")
set(CPACK_DEBIAN_CUDA_PACKAGE_NAME shizuku-cuda)
set(CPACK_DEBIAN_CUDA_PACKAGE_DEPENDS "shizuku (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_MPI_PACKAGE_NAME shizuku-mpi)
set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "shizuku (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS openmpi-bin)
set(CPACK_COMPONENT_MPI_DESCRIPTION "Runs of Shizuku on several processes, by Open MPI.")
set(CPACK_COMPONENT_CUDA_DESCRIPTION "The NVIDIA GPU's backend of Shizuku. Needs the driver alone.")
include(CPack)
