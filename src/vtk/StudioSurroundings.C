// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/StudioSurroundings.H"

#include "optics/StudioPanel.H"

#include <vtkImageData.h>
#include <vtkNew.h>

#include <algorithm>
#include <array>

namespace shizuku
{

vtkSmartPointer<vtkTexture> studioSurroundings()
{
    constexpr int width = 256, height = 128;
    constexpr std::array<StudioPanel, 2> panels{{{40, 110, 28, 62, 6, 6}, {300, 330, 20, 70, 3, 6}}};
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
            for (const StudioPanel& panel : panels) light += panel.light(azimuth, elevation);
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
