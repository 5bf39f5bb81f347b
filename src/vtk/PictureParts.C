// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/PictureParts.H"

#include "core/angles/Degrees.H"
#include "meshes/Creases.H"
#include "meshes/SmoothMesh.H"
#include "vtk/VtkConversion.H"

#include <vtkActor.h>
#include <vtkCleanPolyData.h>
#include <vtkDiskSource.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkLineSource.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSphereSource.h>
#include <vtkTextProperty.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTubeFilter.h>

#include <algorithm>

namespace shizuku
{

namespace
{

vtkSmartPointer<vtkGlyph3DMapper> spheresAt(const std::vector<Vector3>& centres, double diameter)
{
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(diameter/2);
    sphere->SetThetaResolution(20);
    sphere->SetPhiResolution(14);
    vtkNew<vtkPolyData> points;
    points->SetPoints(toPoints(centres));
    const auto mapper = vtkSmartPointer<vtkGlyph3DMapper>::New();
    mapper->SetInputData(points);
    mapper->SetSourceConnection(sphere->GetOutputPort());
    mapper->ScalingOff();
    mapper->ScalarVisibilityOff();
    return mapper;
}

}

void addPlainLiquid(vtkRenderer& renderer, const TriangleMesh& mesh)
{
    // Mirror images would show more of the particles' pattern than of the liquid's shape.
    constexpr int normalPasses = 15;
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(toPolyData(smoothMesh(splitCreases(mesh, creaseAngle), 0, normalPasses)));
    mapper->ScalarVisibilityOff();

    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    vtkProperty& look = *actor->GetProperty();
    look.SetInterpolationToPBR();
    look.SetColor(0.02, 0.24, 0.52);
    look.SetMetallic(0.0);
    look.SetRoughness(0.12);
    look.SetBaseIOR(1.5);
    look.SetCoatStrength(1.0);      // the coat mirrors the studio more strongly than water would: a brighter picture
    look.SetCoatRoughness(0.07);
    look.SetCoatIOR(2.2);
    renderer.AddActor(actor);
}

void addMatteSpheres(vtkRenderer& renderer, const std::vector<Vector3>& centres, double diameter)
{
    vtkNew<vtkActor> actor;
    actor->SetMapper(spheresAt(centres, diameter));
    actor->GetProperty()->SetColor(0.78, 0.76, 0.73);
    actor->GetProperty()->SetAmbient(0.3);
    actor->GetProperty()->SetDiffuse(0.7);
    renderer.AddActor(actor);
}

void addMatteSurface(vtkRenderer& renderer, const TriangleMesh& mesh)
{
    vtkNew<vtkCleanPolyData> merged;
    merged->SetInputData(toPolyData(mesh));
    merged->SetToleranceIsAbsolute(false);
    merged->SetTolerance(1e-6);
    vtkNew<vtkPolyDataNormals> normals;
    normals->SetInputConnection(merged->GetOutputPort());
    normals->SetFeatureAngle(40);
    normals->ConsistencyOff();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(normals->GetOutputPort());
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(0.80, 0.78, 0.74);
    actor->GetProperty()->SetAmbient(0.25);
    actor->GetProperty()->SetDiffuse(0.75);
    renderer.AddActor(actor);
}

void addGlass(vtkRenderer& renderer, const GlassTube& tube)
{
    constexpr double thickness = 0.04;      // of the radius
    const Vector3 top = tube.base + tube.length*tube.axis;
    vtkNew<vtkLineSource> axis;
    axis->SetPoint1(tube.base.x, tube.base.y, tube.base.z);
    axis->SetPoint2(top.x, top.y, top.z);
    vtkNew<vtkTubeFilter> side;
    side->SetInputConnection(axis->GetOutputPort());
    side->SetRadius((1 + thickness)*tube.radius);
    side->SetNumberOfSides(180);
    side->CappingOff();

    vtkNew<vtkDiskSource> ring;
    ring->SetInnerRadius(tube.radius);
    ring->SetOuterRadius((1 + thickness)*tube.radius);
    ring->SetCircumferentialResolution(180);
    const Vector3 hinge = cross(Vector3(0, 0, 1), tube.axis);
    vtkNew<vtkTransform> place;
    place->Translate(top.x, top.y, top.z);
    if (length(hinge) > 0) place->RotateWXYZ(degrees(std::acos(tube.axis.z)), hinge.x, hinge.y, hinge.z);
    vtkNew<vtkTransformPolyDataFilter> rim;
    rim->SetInputConnection(ring->GetOutputPort());
    rim->SetTransform(place);

    const auto add = [&](vtkAlgorithmOutput* surface, double opacity)
    {
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputConnection(surface);
        vtkNew<vtkActor> actor;
        actor->SetMapper(mapper);
        actor->GetProperty()->SetColor(0.86, 0.93, 0.96);
        actor->GetProperty()->SetAmbient(0.6);
        actor->GetProperty()->SetDiffuse(0.4);
        actor->GetProperty()->SetSpecular(0.6);
        actor->GetProperty()->SetSpecularPower(60);
        actor->GetProperty()->SetOpacity(opacity);
        renderer.AddActor(actor);
    };
    add(side->GetOutputPort(), 0.16);
    add(rim->GetOutputPort(), 0.7);
}

namespace
{

// At the right side, with the ends of the range and its middle.
void addBar(vtkRenderer& renderer, vtkLookupTable& colours, const char* title, int fontSize)
{
    vtkNew<vtkScalarBarActor> bar;
    bar->SetLookupTable(&colours);
    bar->SetTitle(title);
    bar->SetNumberOfLabels(3);
    bar->SetLabelFormat("%.3g");
    bar->UnconstrainedFontSizeOn();
    for (vtkTextProperty* text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()})
    {
        text->SetColor(0.15, 0.2, 0.25);
        text->ShadowOff();
        text->ItalicOff();
        text->SetFontSize(fontSize);
    }
    bar->SetPosition(0.9, 0.3);
    bar->SetWidth(0.07);
    bar->SetHeight(0.4);
    renderer.AddActor2D(bar);
}

vtkSmartPointer<vtkLookupTable> patternColours(const PictureScene& scene)
{
    const auto colours = vtkSmartPointer<vtkLookupTable>::New();
    colours->SetHueRange(0.57, 0.1);
    colours->SetSaturationRange(0.5, 0.08);
    colours->SetValueRange(0.6, 0.95);
    const auto [least, most] = std::minmax_element(scene.theta.begin(), scene.theta.end());
    colours->SetRange(*least, *most);
    colours->Build();
    return colours;
}

}

void addPatternLegend(vtkRenderer& renderer, const PictureScene& scene, int fontSize)
{
    addBar(renderer, *patternColours(scene), "theta [\u00B0]", fontSize);
}

void addPattern(vtkRenderer& renderer, const PictureScene& scene)
{
    const Vector3& n = scene.floor->normal;
    vtkNew<vtkRegularPolygonSource> disc;
    disc->SetNumberOfSides(6);
    disc->SetNormal(n.x, n.y, n.z);
    disc->SetRadius(0.6*scene.spacing);
    disc->GeneratePolylineOff();

    vtkNew<vtkFloatArray> theta;
    for (const double value : scene.theta) theta->InsertNextValue(float(value));
    vtkNew<vtkPolyData> points;
    points->SetPoints(toPoints(scene.pattern));
    points->GetPointData()->SetScalars(theta);

    const auto colours = patternColours(scene);
    vtkNew<vtkGlyph3DMapper> mapper;
    mapper->SetInputData(points);
    mapper->SetSourceConnection(disc->GetOutputPort());
    mapper->ScalingOff();
    mapper->SetLookupTable(colours);
    mapper->SetScalarRange(theta->GetRange());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetLighting(false);
    actor->GetProperty()->SetOpacity(0.65);
    renderer.AddActor(actor);
}

void addParticles(vtkRenderer& renderer, const PictureScene& scene, int fontSize)
{
    const auto mapper = spheresAt(scene.particles, scene.spacing);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetSpecular(0.3);
    actor->GetProperty()->SetSpecularPower(30);
    actor->GetProperty()->SetColor(0.10, 0.42, 0.70);
    renderer.AddActor(actor);
    if (scene.speed.empty()) return;

    vtkNew<vtkFloatArray> speed;
    speed->SetName("speed");
    for (const double value : scene.speed) speed->InsertNextValue(float(value));
    static_cast<vtkPolyData*>(mapper->GetInput())->GetPointData()->SetScalars(speed);

    vtkNew<vtkLookupTable> colours;
    colours->SetHueRange(0.62, 0.50);
    colours->SetSaturationRange(0.9, 0.25);
    colours->SetValueRange(0.55, 1.0);
    colours->Build();
    const double fastest = *std::max_element(scene.speed.begin(), scene.speed.end());
    mapper->SetLookupTable(colours);
    mapper->SetScalarRange(0, fastest > 0 ? fastest : 1);
    mapper->ScalarVisibilityOn();

    colours->SetRange(0, fastest > 0 ? fastest : 1);
    addBar(renderer, *colours, "|U| [m/s]", fontSize);
}

}
