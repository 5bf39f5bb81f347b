// SPDX-License-Identifier: GPL-3.0-or-later
#include "AnalyticWalls.H"

#include "caseFiles/AnalyticMesh.H"

namespace shizuku
{

AnalyticWalls::AnalyticWalls(const std::filesystem::path& casePath, const Bounds& about)
{
    if (!std::filesystem::exists(casePath/"constant/walls")) return;
    motions_ = WallMotions::read(casePath);
    for (const AnalyticSurface& surface : readAnalyticSurfaces(Dictionary::read(casePath/"constant/walls")))
    {
        addMesh(mesh_, surface, about);
        wall_.resize(mesh_.vertices.size(), double(motion_.size()));
        motion_.push_back(motions_.indexOf(surface.name));
        moves_ = moves_ || motion_.back() >= 0;
    }
}

void AnalyticWalls::add(VtkSeries& series, double time, int index, double spacing) const
{
    if (mesh_.faces.empty()) return;
    if (!moves_ && series.times() > 0)
    {
        series.repeat(time);
        return;
    }
    std::vector<Pose> poses;
    for (const int motion : motion_) poses.push_back(motion < 0 ? Pose() : motions_.walls()[motion].motion->at(time));
    TriangleMesh now = mesh_;
    for (std::size_t i = 0; i < now.vertices.size(); ++i) now.vertices[i] = poses[std::size_t(wall_[i])](now.vertices[i]);
    VtpContent content = vtpOf(now);
    content.pointFields.push_back({"wall", FieldType::label, dimensions::none, false, wall_});
    series.add(time, index, std::move(content), spacing);
}

}
