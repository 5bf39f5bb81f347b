// SPDX-License-Identifier: GPL-3.0-or-later
#include "vdb/VdbFile.H"

#include "core/fieldFile/AtomicFile.H"
#include "core/messages/Error.H"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <sstream>

namespace shizuku
{

namespace
{

constexpr float reach = 3;          // voxels on both sides of the surface

openvdb::FloatGrid::Ptr levelSetOf(const TriangleMesh& mesh, const openvdb::math::Transform& transform)
{
    std::vector<openvdb::Vec3s> places;
    std::vector<openvdb::Vec3I> triangles;
    for (const Vector3& x : mesh.vertices) places.emplace_back(float(x.x), float(x.y), float(x.z));
    for (const auto& [i, j, k] : mesh.faces) triangles.emplace_back(i, j, k);
    auto grid = openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(transform, places, triangles, reach);
    grid->setName("surface");
    return grid;
}

openvdb::Vec3SGrid::Ptr velocityGrid(const openvdb::FloatGrid& surface, const VelocitiesAt& velocities)
{
    auto grid = openvdb::Vec3SGrid::create();
    grid->setTransform(surface.transform().copy());
    grid->setName("velocity");
    grid->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
    std::vector<openvdb::Coord> voxels;
    std::vector<Vector3> places;
    for (auto voxel = surface.cbeginValueOn(); voxel; ++voxel)
    {
        const openvdb::Vec3d x = surface.transform().indexToWorld(voxel.getCoord());
        voxels.push_back(voxel.getCoord());
        places.push_back({x.x(), x.y(), x.z()});
    }
    const std::vector<Vector3> there = velocities(places);
    auto values = grid->getAccessor();
    for (std::size_t i = 0; i < voxels.size(); ++i) values.setValue(voxels[i], openvdb::Vec3s(float(there[i].x), float(there[i].y), float(there[i].z)));
    return grid;
}

}

void writeVdb(const std::filesystem::path& file, const TriangleMesh& mesh, const VelocitiesAt& velocities, double voxel, double time)
{
    openvdb::initialize();
    const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
    std::ostringstream bytes;
    try
    {
        const openvdb::FloatGrid::Ptr surface = levelSetOf(mesh, *transform);
        openvdb::MetaMap metadata;
        metadata.insertMeta("time", openvdb::DoubleMetadata(time));
        openvdb::io::Stream(bytes).write(openvdb::GridPtrVec{surface, velocityGrid(*surface, velocities)}, metadata);
    }
    catch (const openvdb::Exception& error)
    {
        throw FatalError("OpenVDB could not make " + file.string() + ": " + error.what());
    }
    writeAtomically(file, [&](std::ostream& out) { out << bytes.str(); });
}

}
