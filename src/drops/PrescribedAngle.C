// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/PrescribedAngle.H"

#include "core/dictionary/Dictionary.H"
#include "core/time/Time.H"
#include "thetaModels/ThetaField.H"

namespace shizuku
{

PrescribedAngle::PrescribedAngle
(
    const std::filesystem::path& casePath, const CaseWalls& walls, const std::string& wall
)
: case_(casePath), walls_(walls), wall_(wall)
{
    for (std::size_t i = 0; i < walls.solid.patches.size(); ++i)
    {
        if (walls.solid.patches[i] == wall) patch_ = int(i);
    }
    std::vector<Vector3> places;
    for (std::size_t k = 0; k < walls.solid.positions.size(); ++k)
    {
        if (walls.solid.patch[k] != patch_) continue;
        ofPatch_.push_back(k);
        places.push_back(walls.solid.positions[k]);
    }
    if (!places.empty()) nearest_ = std::make_unique<NearestPoint>(places);
}

void PrescribedAngle::read(double time, const std::vector<double>& inForce)
{
    wallTheta_ = none;
    theta_.clear();
    const auto file = case_/"constant/wettability";
    const Dictionary entry = std::filesystem::exists(file) ? Dictionary::read(file).subDictOrEmpty(wall_) : Dictionary();
    if (entry.lookupOr<std::string>("law", "constant") != "constant") return;      // by which the angle follows the line
    if (patch_ < 0)
    {
        wallTheta_ = entry.lookupOr<double>("theta", none);
        return;
    }
    theta_ = inForce;
    if (!theta_.empty()) return;
    const auto instance = findInstance(case_, time, "solid/theta");
    if (!instance.empty()) theta_ = readTheta(instance, walls_.solid.positions.size());
}

double PrescribedAngle::below(const Vector3& foot, double radius, const Vector3& normal) const
{
    if (theta_.empty()) return wallTheta_;
    const SolidParticles& solid = walls_.solid;
    double sum = 0;
    long count = 0;
    for (std::size_t i = 0; i < solid.positions.size(); ++i)
    {
        const Vector3 fromFoot = solid.positions[i] - foot;
        const Vector3 along = fromFoot - dot(fromFoot, normal)*normal;
        if (solid.patch[i] != patch_ || length(along) > radius || dot(solid.normals[i], normal) <= 0) continue;
        sum += theta_[i];
        ++count;
    }
    return count > 0 ? sum/count : none;
}

double PrescribedAngle::along(const std::vector<LineTangent>& line) const
{
    if (line.empty()) return none;
    if (theta_.empty() || !nearest_) return wallTheta_;
    double sum = 0, total = 0;
    for (const LineTangent& tangent : line)
    {
        sum += tangent.length*theta_[ofPatch_[(*nearest_)(tangent.point)]];
        total += tangent.length;
    }
    return sum/total;
}

}
