// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/StudioSurroundings.H"

#include <vtkImageData.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>

namespace shizuku
{

namespace
{

// A lit panel of the studio, in degrees as seen from the drop; its light falls off softly at the rim.
struct Panel
{
    double fromAzimuth, toAzimuth, fromElevation, toElevation, brightness;

    double lightAt(double azimuth, double elevation) const
    {
        constexpr double rim = 6;
        const double across = std::min(azimuth - fromAzimuth, toAzimuth - azimuth)/rim;
        const double along = std::min(elevation - fromElevation, toElevation - elevation)/rim;
        return brightness*std::clamp(across, 0.0, 1.0)*std::clamp(along, 0.0, 1.0);
    }
};

}

vtkSmartPointer<vtkTexture> studioSurroundings()
{
    constexpr int width = 256, height = 128;
    constexpr std::array<Panel, 2> panels{{{40, 110, 28, 62, 6}, {300, 330, 20, 70, 3}}};
    vtkNew<vtkImageData> image;
    image->SetDimensions(width, height, 1);
    image->AllocateScalars(VTK_FLOAT, 3);
    for (int row = 0; row < height; ++row)
    {
        for (int column = 0; column < width; ++column)
        {
            const double elevation = (double(row)/(height - 1) - 0.5)*180, azimuth = double(column)/width*360;
            double light = elevation < 0
                ? 0.55 - 0.4*std::min(1.0, -elevation/40)       // the liquid's own shadow
                : 0.75 - 0.5*std::min(1.0, elevation/70);
            for (const Panel& panel : panels) light += panel.lightAt(azimuth, elevation);
            auto* pixel = static_cast<float*>(image->GetScalarPointer(column, row, 0));
            pixel[0] = float(light*0.96);
            pixel[1] = float(light*0.98);
            pixel[2] = float(light);
        }
    }
    const auto texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetInputData(image);
    texture->SetColorModeToDirectScalars();
    texture->MipmapOn();
    texture->InterpolateOn();
    return texture;
}

}
