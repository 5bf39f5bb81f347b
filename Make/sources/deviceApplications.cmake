# Applications that run on a device: path below applications/, then the sources in that folder.
set(SHIZUKU_DEVICE_APPLICATIONS
    solvers/pbfDroplet
)
set(pbfDroplet_SOURCES pbfDroplet.C StepControl.C StepReport.C DryRun.C)
