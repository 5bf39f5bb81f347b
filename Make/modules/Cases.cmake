# SPDX-License-Identifier: GPL-3.0-or-later
# What cases need (etc/build -cases): no studies, and no CUDA where no GPU is here.
add_custom_target(cases)
foreach(program caseDictionary runCases fillLiquid sampleTheta sampleSurface probeAngle compareReference shizukuToVTK renderCase
        pbfDroplet meshSurface exportSurface postProcess adviseCase checkCase shizukuView shizukuMpi)
    if(TARGET ${program})
        add_dependencies(cases ${program})
    endif()
endforeach()
