// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/StudioFloor.H"

#include "vtk/SoftShadow.H"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTexture.h>

#include <algorithm>

namespace shizuku
{

namespace
{

constexpr int pixels = 2048;
constexpr double extent = 7;            // half width of the floor in radii of the liquid
constexpr double darkest = 0.55;        // part of the light that a full shadow takes
constexpr double contactDarkness = 0.35;

// Grey of the shadow, and an opacity that falls to nothing towards the border.
vtkSmartPointer<vtkTexture> floorTexture(const PlaneImage& shadow, const PlaneImage& contact)
{
    vtkNew<vtkImageData> image;
    image->SetDimensions(shadow.size, shadow.size, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
    for (int row = 0; row < shadow.size; ++row)
    {
        for (int column = 0; column < shadow.size; ++column)
        {
            const double light = (1 - darkest*shadow.at(column, row))*(1 - contactDarkness*contact.at(column, row));
            const double x = 2.0*column/(shadow.size - 1) - 1, y = 2.0*row/(shadow.size - 1) - 1;
            const double fade = std::clamp((1 - std::hypot(x, y))/0.6, 0.0, 1.0);
            auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(column, row, 0));
            pixel[0] = static_cast<unsigned char>(0.5 + 236*light);
            pixel[1] = static_cast<unsigned char>(0.5 + 234*light);
            pixel[2] = static_cast<unsigned char>(0.5 + 230*light);
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

vtkSmartPointer<vtkActor> studioFloor
(
    const Plane& plane, const TriangleMesh& liquid, const Vector3& centre, double radius, const Vector3& light
)
{
    PlaneImage shadow;
    shadow.centre = centre - plane.distance(centre)*plane.normal;
    shadow.right = perpendicular(plane.normal);
    shadow.up = cross(plane.normal, shadow.right);
    shadow.halfWidth = extent*radius;
    shadow.size = pixels;
    PlaneImage contact = shadow;        // where light from all sides is held off
    double height = 0;                  // what is flat casts a narrow shadow
    for (const Vector3& vertex : liquid.vertices) height = std::max(height, plane.distance(vertex));
    castShadow(shadow, liquid, light, std::min(0.25*radius, 0.5*height));
    castShadow(contact, liquid, -plane.normal, std::min(0.12*radius, 0.25*height));

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
    actor->SetTexture(floorTexture(shadow, contact));
    actor->GetProperty()->LightingOff();        // the texture holds the light already
    return actor;
}

}
