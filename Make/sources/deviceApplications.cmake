# Applications that run on a device: path below applications/, then the sources in that folder.
set(SHIZUKU_DEVICE_APPLICATIONS
    solvers/pbfDroplet
    utilities/postProcessing/meshSurface
)
set(pbfDroplet_SOURCES pbfDroplet.C StepControl.C StepReport.C SubStep.C DryRun.C)
set(meshSurface_SOURCES meshSurface.C)
