// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/StudioFloor.H"

#include "vtk/ClearLiquid.H"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTexture.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace shizuku
{

namespace
{

constexpr unsigned mostPixels = 2048, fewestPixels = 256;      // along a side of the floor
constexpr double extent = 7;            // half width of the floor in radii of the liquid
constexpr double darkest = 0.55;        // part of the light that a full shadow takes
constexpr double contactDarkness = 0.35;

// The floor's light, 1 in the open, red, green and blue.
using FloorLight = std::array<PlaneImage, 3>;

// What is left of the light on the lines between tiles, so many pixels from there to there.
double tileLine(double column, double row, double side, double line)
{
    constexpr double width = 2;
    const auto fromLine = [&](double place) { return std::abs(place - side*std::round(place/side)); };
    return std::min(fromLine(column), fromLine(row)) < width/2 ? line : 1;
}

// Light as colours, and an opacity that falls to nothing towards the border. tile: side in pixels, 0: none; line: what is left of the light on its lines.
vtkSmartPointer<vtkTexture> floorTexture(const FloorLight& light, const PlaneImage& contact, double contactDarkness, double tile, double line)
{
    constexpr std::array<double, 3> white{236, 234, 230};
    const int size = contact.size;
    vtkNew<vtkImageData> image;
    image->SetDimensions(size, size, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
    for (int row = 0; row < size; ++row)
    {
        for (int column = 0; column < size; ++column)
        {
            double own = 1 - contactDarkness*contact.at(column, row);
            if (tile > 0) own *= tileLine(column + 0.5 - 0.5*size, row + 0.5 - 0.5*size, tile, line);
            const double x = 2.0*column/(size - 1) - 1, y = 2.0*row/(size - 1) - 1;
            const double fade = std::clamp((1 - std::hypot(x, y))/0.6, 0.0, 1.0);
            auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(column, row, 0));
            for (int c = 0; c < 3; ++c)
            {
                const double level = white[c]*own*(1 - darkest + darkest*light[c].at(column, row));
                pixel[c] = static_cast<unsigned char>(0.5 + std::clamp(level, 0.0, 255.0));
            }
            pixel[3] = static_cast<unsigned char>(0.5 + 255*fade*fade*(3 - 2*fade));
        }
    }
    const auto texture = vtkSmartPointer<vtkTexture>::New();
    texture->SetInputData(image);
    texture->SetColorModeToDirectScalars();
    texture->InterpolateOn();
    texture->MipmapOn();
    return texture;
}

}

double tileSide(double radius)
{
    const double power = std::pow(10, std::floor(std::log10(0.5*radius))), factor = 0.5*radius/power;
    return power*(factor < 1.5 ? 1 : factor < 3.5 ? 2 : factor < 7.5 ? 5 : 10);
}

vtkSmartPointer<vtkActor> studioFloor
(
    const Plane& plane, const TriangleMesh& liquid, const Vector3& centre, double radius, const Vector3& light, const ClearLiquid* clear, int pictureSize
)
{
    // A picture shows a third or so of the floor: four times its pixels are as fine as it is.
    const int pixels = int(std::clamp(std::bit_ceil(4*unsigned(pictureSize)), fewestPixels, mostPixels));
    PlaneImage shadow;
    shadow.centre = centre - plane.distance(centre)*plane.normal;
    shadow.right = perpendicular(plane.normal);
    shadow.up = cross(plane.normal, shadow.right);
    shadow.halfWidth = extent*radius;
    shadow.size = pixels;
    PlaneImage contact = shadow;        // where light from all sides is held off
    double height = 0;                  // what is flat casts a narrow shadow
    for (const Vector3& vertex : liquid.vertices) height = std::max(height, plane.distance(vertex));
    castShadow(contact, liquid, -plane.normal, std::min(0.12*radius, 0.25*height));
    FloorLight lit{shadow, shadow, shadow};
    if (clear) clear->castLight(lit, light, clear->look().blur*radius);
    else
    {
        castShadow(shadow, liquid, light, std::min(0.25*radius, 0.5*height));
        for (float& value : shadow.values) value = 1 - value;
        lit.fill(shadow);
    }

    const Vector3 corner = shadow.centre - shadow.halfWidth*(shadow.right + shadow.up);
    const Vector3 alongRight = corner + 2*shadow.halfWidth*shadow.right;
    const Vector3 alongUp = corner + 2*shadow.halfWidth*shadow.up;
    vtkNew<vtkPlaneSource> quad;
    quad->SetOrigin(corner.x, corner.y, corner.z);
    quad->SetPoint1(alongRight.x, alongRight.y, alongRight.z);
    quad->SetPoint2(alongUp.x, alongUp.y, alongUp.z);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(quad->GetOutputPort());

    const auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->SetTexture(clear
        ? floorTexture(lit, contact, 0.3*contactDarkness, tileSide(radius)*pixels/(2*shadow.halfWidth), clear->look().lines)
        : floorTexture(lit, contact, contactDarkness, 0, 1));
    actor->GetProperty()->LightingOff();        // the texture holds the light already
    return actor;
}

}
