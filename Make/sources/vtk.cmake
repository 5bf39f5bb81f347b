# Paths below src/.
set(SHIZUKU_VTK_SOURCES
    vtk/Picture.C
    vtk/SoftShadow.C
    vtk/StudioFloor.C
    vtk/TimeSeries.C
    vtk/VirtualDisplay.C
    vtk/VtkConversion.C
    vtk/VtkSeries.C
    vtk/VtpFile.C
)
