# SPDX-License-Identifier: GPL-3.0-or-later
# Paths below src/.
set(SHIZUKU_VTK_SOURCES
    thetaModels/ImageTheta.C
    vtk/GreyImage.C
    vtk/Picture.C
    vtk/PictureParts.C
    vtk/PngFile.C
    vtk/PvtpFile.C
    vtk/PvtpFormat.C
    vtk/SoftShadow.C
    vtk/StudioFloor.C
    vtk/StudioSurroundings.C
    vtk/TimeSeries.C
    vtk/VirtualDisplay.C
    vtk/VtkConversion.C
    vtk/VtkSeries.C
    vtk/VtpFile.C
    vtk/VtpFormat.C
    vtk/ClearLiquid.C
    vtk/FinePicture.C
    vtk/OutsideProgram.C
    vtk/ScaleBar.C
)
