#include "vtk/Picture.H"

#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"
#include "geometry/SmoothMesh.H"
#include "vtk/StudioFloor.H"
#include "vtk/VtkConversion.H"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCleanPolyData.h>
#include <vtkDiskSource.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkLight.h>
#include <vtkLineSource.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderer.h>
#include <vtkPBRLUTTexture.h>
#include <vtkPBRPrefilterTexture.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>
#include <vtkTransform.h>
#include <vtkTransformPolyDataFilter.h>
#include <vtkTubeFilter.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace shizuku
{

namespace
{

constexpr int oversampling = 2;         // the picture is rendered larger and averaged: smooth edges on any driver

// Where to look: the ball around what is to be seen, and the picture's axes.
struct Stage
{
    Vector3 centre;                     // m
    double radius = 0;                  // m
    Vector3 up, right, front;           // unit vectors; front points at the viewer, but for his elevation

    Stage(const std::vector<Vector3>& points, const Vector3& upward, const PictureView& view) : up(upward)
    {
        const Vector3 east = perpendicular(up), south = cross(east, up);
        const double turn = view.azimuth*std::numbers::pi/180;
        right = std::cos(turn)*east - std::sin(turn)*south;
        front = cross(right, up);
        Vector3 low = points.front(), high = low;
        for (const Vector3& p : points)
        {
            for (int axis = 0; axis < 3; ++axis)
            {
                low[axis] = std::min(low[axis], p[axis]);
                high[axis] = std::max(high[axis], p[axis]);
            }
        }
        centre = view.centre.value_or(0.5*(low + high));
        for (const Vector3& p : points) radius = std::max(radius, length(p - centre));
    }

    // A direction of the picture: to the right, up, to the viewer.
    Vector3 direction(double x, double y, double z) const { return normalized(x*right + y*up + z*front); }
};

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

// A photographer's studio as the surroundings that water mirrors: a floor, walls that darken upwards, two panels.
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

void addSurroundings(vtkOpenGLRenderer& renderer, const Stage& stage)
{
    renderer.UseImageBasedLightingOn();
    renderer.SetEnvironmentTexture(studioSurroundings());
    renderer.SetEnvironmentUp(stage.up.x, stage.up.y, stage.up.z);
    renderer.SetEnvironmentRight(stage.right.x, stage.right.y, stage.right.z);
    // Enough for soft panels; VTK's own choice takes seconds where no graphics hardware is.
    renderer.GetEnvMapPrefiltered()->SetPrefilterMaxSamples(128);
    renderer.GetEnvMapLookupTable()->SetLUTSize(256);
    renderer.GetEnvMapLookupTable()->SetLUTSamples(128);
}

vtkSmartPointer<vtkActor> waterActor(const TriangleMesh& mesh)
{
    // Mirror images would show more of the particles' pattern than of the liquid's shape.
    constexpr int positionPasses = 10, normalPasses = 15;
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(toPolyData(smoothMesh(mesh, positionPasses, normalPasses)));
    mapper->ScalarVisibilityOff();

    const auto actor = vtkSmartPointer<vtkActor>::New();
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
    return actor;
}

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

void addMatteSpheres(vtkRenderer& renderer, const std::vector<Vector3>& centres, double diameter)
{
    vtkNew<vtkActor> actor;
    actor->SetMapper(spheresAt(centres, diameter));
    actor->GetProperty()->SetColor(0.78, 0.76, 0.73);
    actor->GetProperty()->SetAmbient(0.3);
    actor->GetProperty()->SetDiffuse(0.7);
    renderer.AddActor(actor);
}

// A matte surface, smooth but for edges of more than 40 degrees.
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

// Clear glass with a bright rim; what is behind it is drawn before.
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
    if (length(hinge) > 0) place->RotateWXYZ(std::acos(tube.axis.z)*180/std::numbers::pi, hinge.x, hinge.y, hinge.z);
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

// Discs on the floor, blue where it wets best and light where least; the floor's shadow shines through.
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

    vtkNew<vtkLookupTable> colours;
    colours->SetHueRange(0.57, 0.1);
    colours->SetSaturationRange(0.5, 0.08);
    colours->SetValueRange(0.6, 0.95);
    colours->Build();
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

// Particles coloured by speed, dark blue to light, with a scalar bar.
void addParticles(vtkRenderer& renderer, const PictureScene& scene)
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

    vtkNew<vtkScalarBarActor> bar;
    bar->SetLookupTable(colours);
    colours->SetRange(0, fastest > 0 ? fastest : 1);
    bar->SetTitle("|U| [m/s]");
    bar->SetNumberOfLabels(3);
    bar->SetLabelFormat("%.2g");
    bar->UnconstrainedFontSizeOn();
    for (vtkTextProperty* text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()})
    {
        text->SetColor(0.15, 0.2, 0.25);
        text->ShadowOff();
        text->ItalicOff();
        text->SetFontSize(18*oversampling);
    }
    bar->SetPosition(0.9, 0.3);
    bar->SetWidth(0.07);
    bar->SetHeight(0.4);
    renderer.AddActor2D(bar);
}

void addLight(vtkRenderer& renderer, const Stage& stage, const Vector3& towards, double intensity)
{
    const Vector3 position = stage.centre + 20*stage.radius*towards;
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(position.x, position.y, position.z);
    light->SetFocalPoint(stage.centre.x, stage.centre.y, stage.centre.z);
    light->SetIntensity(intensity);
    renderer.AddLight(light);
}

// Half the height of what is seen at the stage's centre [m].
double halfHeight(const Stage& stage, const std::vector<Vector3>& seen, const PictureView& view, double elevation)
{
    const double aspect = double(view.width)/view.height;
    if (view.extent) return *view.extent/(2*aspect);
    constexpr double filled = 0.64;     // of the picture, by the liquid
    const Vector3 viewUp = std::cos(elevation)*stage.up - std::sin(elevation)*stage.front;
    double half = 0;
    for (const Vector3& p : seen)
    {
        half = std::max(half, std::abs(dot(p - stage.centre, viewUp)));
        half = std::max(half, std::abs(dot(p - stage.centre, stage.right))/aspect);
    }
    return half/filled;
}

void aimCamera
(
    vtkRenderer& renderer, const Stage& stage, const std::vector<Vector3>& seen, const PictureView& view
)
{
    using Kind = PictureView::Kind;
    const double elevation = (view.kind == Kind::side ? 3 : view.kind == Kind::above ? 55 : 20)*std::numbers::pi/180;
    const double opening = 24;      // degrees, of the picture's height
    const double distance = halfHeight(stage, seen, view, elevation)/std::tan(opening/2*std::numbers::pi/180);
    const Vector3 position = stage.centre + distance*stage.direction(0, std::sin(elevation), std::cos(elevation));

    vtkCamera& camera = *renderer.GetActiveCamera();
    camera.SetViewAngle(opening);
    camera.SetFocalPoint(stage.centre.x, stage.centre.y, stage.centre.z);
    camera.SetPosition(position.x, position.y, position.z);
    camera.SetViewUp(stage.up.x, stage.up.y, stage.up.z);
    renderer.ResetCameraClippingRange();
}

void addCaption(vtkRenderer& renderer, const std::string& text, int fontSize)
{
    vtkNew<vtkTextActor> caption;
    caption->SetInput(text.c_str());
    caption->GetTextProperty()->SetFontFamilyToArial();
    caption->GetTextProperty()->SetFontSize(std::max(10, fontSize));
    caption->GetTextProperty()->SetColor(0.15, 0.2, 0.25);
    caption->GetTextProperty()->SetLineSpacing(1.2);
    caption->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    caption->SetPosition(0.03, 0.04);
    renderer.AddActor2D(caption);
}

void writePng(vtkRenderWindow& window, const std::filesystem::path& file)
{
    vtkNew<vtkWindowToImageFilter> grab;
    grab->SetInput(&window);
    grab->ReadFrontBufferOff();
    vtkNew<vtkImageShrink3D> shrink;
    shrink->SetInputConnection(grab->GetOutputPort());
    shrink->SetShrinkFactors(oversampling, oversampling, 1);
    shrink->AveragingOn();
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(shrink->GetOutputPort());
    writer->WriteToMemoryOn();
    writer->Write();
    if (!writer->GetResult()) throw FatalError("VTK could not encode " + file.string());
    writeAtomically(file, [&](std::ostream& out)
    {
        vtkUnsignedCharArray& bytes = *writer->GetResult();
        out.write(reinterpret_cast<const char*>(bytes.GetPointer(0)), bytes.GetNumberOfValues());
    });
}

}

void renderPicture(const PictureScene& scene, const PictureView& view, const std::filesystem::path& file)
{
    const std::vector<Vector3>& seen = scene.liquid.vertices.empty() ? scene.particles : scene.liquid.vertices;
    if (seen.empty()) throw FatalError("There is no liquid to be seen in " + file.string());
    const Stage stage(seen, scene.up, view);

    vtkNew<vtkOpenGLRenderer> renderer;
    renderer->GradientBackgroundOn();
    renderer->SetBackground(0.97, 0.975, 0.98);
    renderer->SetBackground2(0.76, 0.84, 0.91);
    renderer->AutomaticLightCreationOff();
    const Vector3 keyLight = stage.direction(-0.5, 1.0, 0.45);
    addLight(*renderer, stage, keyLight, 1.0);
    addLight(*renderer, stage, stage.direction(0.8, 0.5, 0.6), 0.4);

    if (!scene.liquid.faces.empty())
    {
        addSurroundings(*renderer, stage);
        renderer->AddActor(waterActor(scene.liquid));
    }
    else addParticles(*renderer, scene);
    if (!scene.walls.faces.empty()) addMatteSurface(*renderer, scene.walls);
    if (!scene.solid.empty()) addMatteSpheres(*renderer, scene.solid, scene.spacing);
    if (scene.floor)
    {
        renderer->AddActor(studioFloor(*scene.floor, scene.liquid, stage.centre, stage.radius, -keyLight));
    }
    if (scene.floor && !scene.pattern.empty()) addPattern(*renderer, scene);
    for (const GlassTube& tube : scene.glass) addGlass(*renderer, tube);
    if (!scene.caption.empty()) addCaption(*renderer, scene.caption, oversampling*view.width/60);

    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(oversampling*view.width, oversampling*view.height);
    window->AddRenderer(renderer);
    aimCamera(*renderer, stage, seen, view);
    window->Render();
    writePng(*window, file);
}

}
