# SPDX-License-Identifier: GPL-3.0-or-later
# Applications that run on a device: path below applications/, then the sources in that folder, and which of them launch kernels.
set(SHIZUKU_DEVICE_APPLICATIONS
    solvers/pbfDroplet
    utilities/postProcessing/meshSurface
    utilities/postProcessing/postProcess
    utilities/preProcessing/adviseCase
    utilities/preProcessing/checkCase
)
set(pbfDroplet_SOURCES
    pbfDroplet.C CaseChanges.C CaseSeries.C CaseWriter.C Divergence.C FallenLiquid.C LiveView.C PreparedCase.C SameFiles.C SharedRun.C SlipReport.C StartWarnings.C StepReport.C ProfileReport.C Ceilings.C
)
set(pbfDroplet_KERNELS ProfileReport.C Ceilings.C FallenLiquid.C)
set(pbfDroplet_LINK shizukuLiveView)
set(meshSurface_SOURCES meshSurface.C MeshTimes.C CleanedMesh.C)
set(postProcess_SOURCES postProcess.C)
set(adviseCase_SOURCES adviseCase.C CaseForecast.C SolverStart.C)
set(adviseCase_LINK shizukuAdvice)
set(checkCase_SOURCES checkCase.C Findings.C LiquidReport.C SolidReport.C SolvedCase.C)
set(meshSurface_PLUGINS shizukuVtk)     # the format vtp, where VTK is
set(adviseCase_PLUGINS shizukuSampling) # bodies of liquid out of surfaces, where CGAL is
set(checkCase_PLUGINS shizukuSampling)
