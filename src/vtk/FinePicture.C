// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtk/FinePicture.H"

#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"
#include "meshes/Creases.H"
#include "meshes/SmoothMesh.H"
#include "vtk/OutsideProgram.H"
#include "vtk/PictureParts.H"
#include "vtk/StudioFloor.H"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

namespace shizuku
{

namespace
{

constexpr int smoothingPasses = 12;     // as of the quick picture
constexpr double turbid = 0.1;          // blur of the light behind liquid that gathers none

// A folder for what goes to povray and comes back.
class Workshop
{
public:
    Workshop()
    {
        std::string name = (std::filesystem::temp_directory_path()/"shizukuPovrayXXXXXX").string();
        if (!mkdtemp(name.data())) throw FatalError("No folder can be made in " + std::filesystem::temp_directory_path().string());
        path = name;
    }
    ~Workshop()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    Workshop(const Workshop&) = delete;

    std::filesystem::path path;
};

// POV-Ray's scene language. Lengths are radii of the stage, from its centre.
class PovScene
{
public:
    PovScene(const PictureScene& scene, const FineStage& stage) : scene_(scene), stage_(stage) { text_.precision(7); }

    std::string text(const PictureCamera& camera)
    {
        text_ << "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 16 photons { count 200000 } }\n";
        addCamera(camera);
        addLight();
        if (scene_.floor) addFloor(*scene_.floor);
        addLiquid();
        if (!scene_.walls.faces.empty()) addMesh(scene_.walls, matte);
        for (const Vector3& x : scene_.solid) text_ << "sphere { " << place(x) << ", " << 0.5*scene_.spacing/stage_.radius << ' ' << matte << " }\n";
        return text_.str();
    }

private:
    static constexpr const char* matte = "pigment { srgb <0.78, 0.77, 0.75> } finish { ambient 0 diffuse 0.8 emission 0.3 }";

    static std::string vector(const Vector3& v)
    {
        std::ostringstream text;
        text.precision(7);
        text << '<' << v.x << ',' << v.y << ',' << v.z << '>';
        return text.str();
    }
    std::string place(const Vector3& x) const { return vector((1/stage_.radius)*(x - stage_.centre)); }

    const LiquidLook& look() const { return liquidLook(scene_.look); }

    void addCamera(const PictureCamera& camera)
    {
        text_ << "camera { perspective location " << place(camera.position) << " direction " << vector(camera.forward) << " right "
              << vector(2*camera.halfWidth*camera.right) << " up " << vector(2*camera.halfHeight*camera.up) << " }\n";
        // Bright at the horizon and darker upwards, as the quick picture's studio.
        text_ << "sky_sphere { pigment { gradient " << vector(scene_.up) << " scale 2 translate " << vector(-1*scene_.up)
              << " color_map { [0 srgb 0.45] [0.45 srgb <0.9,0.91,0.92>] [0.5 srgb <0.96,0.97,0.98>] [0.62 srgb <0.76,0.84,0.91>] [1 srgb <0.35,0.4,0.45>] } } }\n";
    }

    void addLight()
    {
        const Vector3 across = perpendicular(stage_.light), along = cross(stage_.light, across);
        text_ << "light_source { " << vector(20*stage_.light) << " srgb 0.95 area_light " << vector(3*across) << ", " << vector(3*along)
              << ", 5, 5 adaptive 1 jitter circular orient photons { reflection on refraction on area_light } }\n";
    }

    // With the quick picture's tiles.
    void addFloor(const Plane& floor)
    {
        const Vector3 right = perpendicular(floor.normal), ahead = cross(floor.normal, right);
        const Vector3 origin = stage_.centre - (floor.distance(stage_.centre) - 0.03*scene_.spacing)*floor.normal;     // above the liquid's foot: no air is between
        const double tile = tileSide(stage_.radius)/stage_.radius, line = 0.5*tile/50;
        const Vector3 at = (1/stage_.radius)*(origin - stage_.centre);
        const std::string tileColour = vector(look().lines*Vector3(0.925, 0.918, 0.902));
        text_ << "plane { y, 0 pigment { function { min(abs(x/" << tile << " - floor(x/" << tile << " + 0.5)), abs(z/" << tile << " - floor(z/" << tile
              << " + 0.5))) } color_map { [0 srgb " << tileColour << "] [" << line/tile << " srgb " << tileColour << "] [" << line/tile
              << " srgb <0.925,0.918,0.902>] [1 srgb <0.925,0.918,0.902>] } } finish { ambient 0 diffuse 0.85 emission 0.3 } matrix <";
        std::string separator;
        for (const Vector3& axis : {right, floor.normal, ahead, at})
        {
            text_ << std::exchange(separator, ",") << axis.x << ',' << axis.y << ',' << axis.z;
        }
        text_ << "> }\n";
    }

    void addLiquid()
    {
        const LiquidLook& look = this->look();
        std::ostringstream how;
        how.precision(7);
        if (look.isMetal)
        {
            how << "pigment { srgb " << vector(look.mirrors) << " } finish { ambient 0 diffuse 0.02 reflection { " << vector(look.mirrors) << " metallic } }";
        }
        else
        {
            // What passes falls with the depth as exp(-(1 - fade_color) depth/fade_distance); a tenth of the width keeps dark colours above 0. Looks are of
            // levels on a screen, and light goes with their power 2.2.
            constexpr double part = 0.1, gamma = 2.2;
            Vector3 colour;
            for (int c = 0; c < 3; ++c) colour[c] = 1 + part*gamma*std::log(look.passes[c]);
            how << "pigment { rgbf 1 } finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel on } conserve_energy } interior { ior " << look.index
                << " fade_power 1001 fade_distance " << 2*part << " fade_color rgb " << vector(colour) << " }";
            if (look.blur < turbid) how << " photons { target reflection on refraction on collect off }";
        }
        addMesh(smoothMesh(splitCreases(scene_.liquid, creaseAngle), 0, smoothingPasses), how.str());
    }

    void addMesh(const TriangleMesh& mesh, const std::string& how)
    {
        text_ << "mesh2 { vertex_vectors { " << mesh.vertices.size();
        for (const Vector3& x : mesh.vertices) text_ << ",\n" << place(x);
        text_ << " }\n";
        if (!mesh.normals.empty())
        {
            text_ << "normal_vectors { " << mesh.normals.size();
            for (const Vector3& n : mesh.normals) text_ << ",\n" << vector(n);
            text_ << " }\n";
        }
        text_ << "face_indices { " << mesh.faces.size();
        for (const auto& [i, j, k] : mesh.faces) text_ << ",\n<" << i << ',' << j << ',' << k << '>';
        text_ << " }\ninside_vector " << vector(scene_.up) << ' ' << how << " }\n";
    }

    const PictureScene& scene_;
    const FineStage& stage_;
    std::ostringstream text_;
};

std::string contentOf(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// A binary PPM of 8 bits, which goes down from its first row, with a comment behind its first line.
PixelImage readPpm(const std::filesystem::path& file, int width, int height)
{
    std::istringstream in(contentOf(file));
    std::string magic, comment;
    int columns = 0, rows = 0, most = 0;
    in >> magic >> std::ws;
    while (in.peek() == '#') std::getline(in, comment);
    in >> columns >> rows >> most;
    in.get();
    PixelImage image{width, height, std::vector<unsigned char>(3*std::size_t(width)*height), {}};
    bool isWhole = magic == "P6" && columns == width && rows == height && most == 255;
    for (int row = height - 1; row >= 0 && isWhole; --row)
    {
        isWhole = bool(in.read(reinterpret_cast<char*>(&image.levels[3*std::size_t(row)*width]), 3*std::streamsize(width)));
    }
    if (!isWhole) throw FatalError("povray left no picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
    return image;
}

}

PixelImage finePicture(const PictureScene& scene, const PictureCamera& camera, const FineStage& stage, int width, int height)
{
    const Workshop workshop;
    const auto source = workshop.path/"scene.pov", picture = workshop.path/"picture.ppm", log = workshop.path/"log";
    writeAtomically(source, [&](std::ostream& out) { out << PovScene(scene, stage).text(camera); });
    const int status = runOutsideProgram
    (
        "povray", {"+I" + source.string(), "+O" + picture.string(), "+FP", "+W" + std::to_string(width), "+H" + std::to_string(height), "-D", "-GA", "+GF", "+Q9"}, log
    );
    if (status == 127) throw FatalError("Fine pictures are made by POV-Ray, which is not installed: install the package povray, or choose another -look");
    if (status != 0) throw FatalError("povray could not make the picture:\n" + contentOf(log));
    return readPpm(picture, width, height);
}

}
