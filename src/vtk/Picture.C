// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/Picture.H"

#include "core/angles/Degrees.H"
#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"
#include "meshes/Bounds.H"
#include "vtk/ClearLiquid.H"
#include "vtk/FinePicture.H"
#include "vtk/PictureParts.H"
#include "vtk/ScaleBar.H"
#include "vtk/StudioFloor.H"
#include "vtk/StudioSurroundings.H"

#include <vtkActor2D.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageMapper.h>
#include <vtkImageShrink3D.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkOpenGLRenderer.h>
#include <vtkPBRLUTTexture.h>
#include <vtkPBRPrefilterTexture.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace shizuku
{

namespace
{

constexpr int oversampling = 2;         // the picture is rendered larger and averaged: smooth edges on any driver
constexpr int leastFont = 12;           // pixels, of captions in small pictures

// Where to look: the ball around what is to be seen, and the picture's axes.
struct Stage
{
    Vector3 centre;                     // m
    double radius = 0;                  // m
    Vector3 up, right, front;           // unit vectors; front points at the viewer, but for his elevation

    Stage(const std::vector<Vector3>& points, const Vector3& upward, const PictureView& view) : up(upward)
    {
        const Vector3 east = perpendicular(up), south = cross(east, up);
        const double turn = radians(view.azimuth);
        right = std::cos(turn)*east - std::sin(turn)*south;
        front = cross(right, up);
        const Bounds bounds = boundsOf(points);
        centre = view.centre.value_or(0.5*(bounds.low + bounds.high));
        for (const Vector3& p : points) radius = std::max(radius, length(p - centre));
    }

    // A direction of the picture: to the right, up, to the viewer.
    Vector3 direction(double x, double y, double z) const { return normalized(x*right + y*up + z*front); }
};

std::vector<Vector3> cornersOf(const Bounds& box)
{
    std::vector<Vector3> corners;
    for (int i = 0; i < 8; ++i)
    {
        corners.push_back({i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y, i & 4 ? box.high.z : box.low.z});
    }
    return corners;
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
    constexpr double filled = 0.64;     // of the picture, by the frame
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
    vtkRenderer& renderer, const Stage& stage, const std::vector<Vector3>& seen, const PictureView& view, bool hangs
)
{
    using Kind = PictureView::Kind;
    const double elevation = (hangs ? -1 : 1)*radians(view.kind == Kind::side ? 3 : view.kind == Kind::above ? 55 : 20);
    const double opening = 24;      // degrees, of the picture's height
    const double distance = halfHeight(stage, seen, view, elevation)/std::tan(radians(opening/2));
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
    caption->GetTextProperty()->SetFontSize(fontSize);
    caption->GetTextProperty()->SetColor(0.15, 0.2, 0.25);
    caption->GetTextProperty()->SetLineSpacing(1.2);
    caption->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    caption->SetPosition(0.03, 0.04);
    renderer.AddActor2D(caption);
}

// The window as it is, and how far away what it shows is.
PixelImage grabbed(vtkRenderWindow& window, vtkRenderer& renderer)
{
    PixelImage image;
    image.width = window.GetSize()[0];
    image.height = window.GetSize()[1];
    image.levels.resize(3*std::size_t(image.width)*image.height);
    vtkNew<vtkUnsignedCharArray> levels;
    levels->SetArray(image.levels.data(), vtkIdType(image.levels.size()), 1);
    window.GetPixelData(0, 0, image.width - 1, image.height - 1, 0, levels);
    std::vector<float> depth(std::size_t(image.width)*image.height);
    window.GetZbufferData(0, 0, image.width - 1, image.height - 1, depth.data());
    const double* const range = renderer.GetActiveCamera()->GetClippingRange();
    const double near = range[0], far = range[1];
    image.depth.reserve(depth.size());
    for (const float z : depth) image.depth.push_back(near*far/(far - z*(far - near)));
    return image;
}

PictureCamera cameraOf(vtkRenderer& renderer, const PictureView& view)
{
    vtkCamera& own = *renderer.GetActiveCamera();
    PictureCamera camera;
    camera.position = std::to_array({own.GetPosition()[0], own.GetPosition()[1], own.GetPosition()[2]});
    camera.forward = std::to_array({own.GetDirectionOfProjection()[0], own.GetDirectionOfProjection()[1], own.GetDirectionOfProjection()[2]});
    const Vector3 up(own.GetViewUp()[0], own.GetViewUp()[1], own.GetViewUp()[2]);
    camera.right = normalized(cross(camera.forward, up));
    camera.up = cross(camera.right, camera.forward);
    camera.halfHeight = std::tan(radians(own.GetViewAngle()/2));
    camera.halfWidth = camera.halfHeight*view.width/view.height;
    return camera;
}

// What the picture shows at its centre from side to side [m].
double widthAt(const Vector3& centre, const PictureCamera& camera)
{
    return 2*camera.halfWidth*camera.depth(centre);
}

// In place of all that the renderer has shown.
void show(vtkRenderer& renderer, const PixelImage& picture)
{
    vtkNew<vtkImageData> image;
    image->SetDimensions(picture.width, picture.height, 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
    std::copy(picture.levels.begin(), picture.levels.end(), static_cast<unsigned char*>(image->GetScalarPointer()));
    vtkNew<vtkImageMapper> mapper;
    mapper->SetInputData(image);
    mapper->SetColorWindow(255);
    mapper->SetColorLevel(127.5);
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    renderer.RemoveAllViewProps();
    renderer.AddActor2D(actor);
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
    const std::vector<Vector3> framed = view.frame ? cornersOf(*view.frame) : seen;
    const Stage stage(framed, scene.up, view);
    const bool hangs = scene.floor && dot(scene.floor->normal, scene.up) < -0.5;        // more than it leans

    vtkNew<vtkOpenGLRenderer> renderer;
    renderer->GradientBackgroundOn();
    renderer->SetBackground(0.97, 0.975, 0.98);
    renderer->SetBackground2(0.76, 0.84, 0.91);
    renderer->AutomaticLightCreationOff();
    const double open = hangs ? -1 : 1;                 // the side of the wall where the liquid is
    const Vector3 keyLight = stage.direction(-0.5, open, 0.45);
    addLight(*renderer, stage, keyLight, 1.0);
    addLight(*renderer, stage, stage.direction(0.8, 0.5*open, 0.6), 0.4);

    std::optional<ClearLiquid> clear;
    if (scene.liquid.faces.empty()) addParticles(*renderer, scene, 18*oversampling);
    else if (scene.look == "plain")
    {
        addSurroundings(*renderer, stage);
        addPlainLiquid(*renderer, scene.liquid);
    }
    else clear.emplace(scene, liquidLook(scene.look), stage.radius, Studio(open*stage.up, stage.right, stage.front));
    if (!scene.walls.faces.empty()) addMatteSurface(*renderer, scene.walls);
    if (!scene.solid.empty()) addMatteSpheres(*renderer, scene.solid, scene.spacing);
    if (scene.floor)
    {
        renderer->AddActor(studioFloor(
            *scene.floor, scene.liquid, stage.centre, stage.radius, -keyLight, clear ? &*clear : nullptr, std::max(view.width, view.height)));
    }
    if (scene.floor && !scene.pattern.empty()) addPattern(*renderer, scene);
    for (const GlassTube& tube : scene.glass) addGlass(*renderer, tube);

    vtkNew<vtkRenderWindow> window;
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(oversampling*view.width, oversampling*view.height);
    window->AddRenderer(renderer);
    aimCamera(*renderer, stage, framed, view, hangs);
    const PictureCamera camera = cameraOf(*renderer, view);
    std::string caption = scene.caption;
    if (clear)
    {
        if (scene.isFine) show(*renderer, finePicture(scene, camera, {stage.centre, stage.radius, keyLight}, oversampling*view.width, oversampling*view.height));
        else
        {
            window->Render();
            PixelImage picture = grabbed(*window, *renderer);
            clear->draw(picture, camera);
            show(*renderer, picture);
        }
        if (scene.floor) caption.append(caption.empty() ? "" : "\n").append("tiles of " + lengthText(tileSide(stage.radius)));
    }
    if (scene.floor && !scene.pattern.empty() && !scene.isFine) addPatternLegend(*renderer, scene, oversampling*std::max(leastFont, view.width/80));
    const int fontSize = oversampling*std::max(leastFont, view.width/60);
    if (!caption.empty()) addCaption(*renderer, caption, fontSize);
    addScaleBar(*renderer, widthAt(stage.centre, camera), oversampling*view.width, fontSize);
    window->Render();
    writePng(*window, file);
}

}
