#include "geometry/drops/PrescribedAngle.H"

#include "core/dictionary/Dictionary.H"
#include "core/fieldFile/FieldFile.H"
#include "core/time/Time.H"

#include <limits>

namespace shizuku
{

namespace
{

constexpr double none = std::numeric_limits<double>::quiet_NaN();

}

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
}

void PrescribedAngle::read(double time)
{
    theta_.clear();
    if (patch_ < 0) return readWall();
    const auto instance = findInstance(case_, time, "solid/theta");
    if (instance.empty()) return;
    const std::size_t count = walls_.solid.positions.size();
    const FieldData field = readField(instance/"solid/theta", FieldType::scalar, dimensions::none, long(count));
    for (std::size_t i = 0; i < count; ++i) theta_.push_back(field(i));
}

void PrescribedAngle::take(const std::vector<double>& theta)
{
    if (patch_ < 0) return readWall();
    theta_ = theta;
}

void PrescribedAngle::readWall()
{
    const auto file = case_/"constant/wettability";
    wallTheta_.reset();
    if (std::filesystem::exists(file)) wallTheta_ = Dictionary::read(file).subDictOrEmpty(wall_).lookupOr<double>("theta", none);
}

double PrescribedAngle::below(const Vector3& foot, double radius, const Vector3& normal) const
{
    if (theta_.empty()) return wallTheta_.value_or(none);
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

}
