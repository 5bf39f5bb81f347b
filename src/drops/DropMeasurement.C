// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/DropMeasurement.H"

#include "caseFiles/CaseGravity.H"
#include "caseFiles/UnitVector.H"
#include "drops/ProfileFoot.H"
#include "meshes/NearestPoint.H"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

namespace shizuku
{

namespace
{

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Dictionary liquidOf(const std::filesystem::path& casePath)
{
    const auto file = casePath/"constant/liquidProperties";
    return std::filesystem::exists(file) ? Dictionary::read(file) : Dictionary();
}

// Numbers of drops, each with so many that say something of it.
std::vector<std::vector<double>> eachOf(const KeptNumbers& state, const std::string& name, std::size_t together)
{
    std::vector<std::vector<double>> each;
    const auto found = state.find(name);
    if (found == state.end()) return each;
    for (auto next = found->second.begin(); std::size_t(found->second.end() - next) >= together; next += long(together))
    {
        each.emplace_back(next, next + long(together));
    }
    return each;
}

// Solid particles lie half a spacing inside of their walls, which end with them.
DistanceToWalls distanceToOthers(const CaseWalls& walls, const std::string& wall, double spacing)
{
    std::vector<AnalyticSurface> surfaces;
    for (const AnalyticSurface& surface : walls.analytic) if (surface.name != wall) surfaces.push_back(surface);
    std::vector<Vector3> particles;
    for (std::size_t i = 0; i < walls.solid.positions.size(); ++i)
    {
        if (walls.solid.patches[walls.solid.patch[i]] != wall) particles.push_back(walls.solid.positions[i]);
    }
    if (surfaces.empty() && particles.empty()) return {};
    std::shared_ptr<const NearestPoint> nearest;
    if (!particles.empty()) nearest = std::make_shared<const NearestPoint>(particles);
    return [=](const Vector3& x)
    {
        double least = std::numeric_limits<double>::infinity();
        for (const AnalyticSurface& surface : surfaces) least = std::min(least, std::abs(surface.signedDistance(x)));
        if (nearest) least = std::min(least, length(x - particles[(*nearest)(x)]) - 0.5*spacing);
        return least;
    };
}

}

DropControls DropControls::read(const Dictionary& dict, const CaseWalls& walls)
{
    DropControls controls;
    if (dict.found("wall") || walls.names.size() != 1) controls.wall = dict.lookupChoice("wall", walls.names);
    else controls.wall = walls.names.front();
    if (dict.found("fitAbove"))
    {
        controls.limits.fitAbove = dict.lookupPositive("fitAbove", dimensions::none, true);
    }
    if (dict.found("direction")) controls.direction = readUnitVector(dict, "direction");
    return controls;
}

DropMeasurement::DropMeasurement
(
    const std::filesystem::path& casePath, const DropControls& controls, CaseWalls walls, double spacing
)
:
    walls_(std::move(walls)), controls_(controls), spacing_(spacing),
    wall_(makeWallShape(walls_, controls.wall, spacing)), prescribed_(casePath, walls_, controls.wall), law_(casePath, controls.wall), others_(distanceToOthers(walls_, controls.wall, spacing)), case_(casePath)
{}

void DropMeasurement::readCase(double time, const std::vector<double>& inForce)
{
    prescribed_.read(time, inForce);
    gravity_ = caseGravity(case_);
    const Dictionary liquid = liquidOf(case_);
    density_ = liquid.found("rho") ? liquid.lookupPositive("rho", dimensions::density) : unknown;
    tension_ = liquid.found("sigma") ? liquid.lookupPositive("sigma", dimensions::surfaceTension, true) : unknown;
    law_.read();
}

std::vector<Drop> DropMeasurement::dropsOf(const TriangleMesh& surface) const
{
    constexpr double smallest = 20;         // particles
    return separateDrops(surface, smallest*spacing_*spacing_*spacing_);
}

std::vector<DropRecord> DropMeasurement::measure(const std::vector<Drop>& drops, const std::vector<long>& particles, double time, const HeldAngles& held) const
{
    std::vector<DropRecord> records;
    for (std::size_t k = 0; k < drops.size(); ++k)
    {
        records.push_back(measureDrop(drops[k], drops[k].surface.centroid(), particles[k], time, held));
    }
    return records;
}

void DropMeasurement::number(std::vector<DropRecord>& records)
{
    std::vector<Vector3> centroids;
    for (const DropRecord& record : records) centroids.push_back(record.centroid);
    const std::vector<int> numbers = numbers_.assign(centroids);
    for (std::size_t i = 0; i < records.size(); ++i)
    {
        DropRecord& record = records[i];
        record.drop = numbers[i];
        record.firstDrift = record.volume/firstVolumes_.try_emplace(record.drop, record.volume).first->second - 1;
    }
    std::sort(records.begin(), records.end(), [](const auto& a, const auto& b) { return a.drop < b.drop; });
}

KeptNumbers DropMeasurement::state() const
{
    KeptNumbers state;
    if (numbers_.last() == 0) return state;
    state["lastDrop"] = {double(numbers_.last())};
    for (const auto& [number, x] : numbers_.known())
    {
        for (const double each : {double(number), x.x, x.y, x.z}) state["drops"].push_back(each);
    }
    for (const auto& [number, volume] : firstVolumes_)
    {
        for (const double each : {double(number), volume}) state["firstVolumes"].push_back(each);
    }
    return state;
}

void DropMeasurement::goOn(const KeptNumbers& state)
{
    std::vector<DropNumbers::Known> known;
    for (const auto& drop : eachOf(state, "drops", 4)) known.push_back({int(drop[0]), {drop[1], drop[2], drop[3]}});
    for (const auto& last : eachOf(state, "lastDrop", 1)) numbers_.goOn(known, int(last[0]));
    for (const auto& first : eachOf(state, "firstVolumes", 2)) firstVolumes_[int(first[0])] = first[1];
}

DropRecord DropMeasurement::measureDrop(const Drop& drop, const Vector3& centroid, long particles, double time, const HeldAngles& held) const
{
    DropRecord record;
    record.time = time;
    record.shape = measureContactAngle
    (
        drop.surface, *wall_, spacing_, controls_.direction.value_or(gravity_), controls_.limits, others_
    );
    record.volume = drop.volume;
    record.particles = particles;
    record.particleDrift = drop.volume/(record.particles*spacing_*spacing_*spacing_) - 1;
    record.centroid = centroid;
    const double footprint = std::sqrt(record.shape.coveredArea/std::numbers::pi);
    record.prescribed = prescribed_.below(centroid, footprint, wall_->at(centroid).normal);
    if (law_.isThere()) record.line = law_.stateOf(record.shape.line, held, spacing_);
    else record.line.theta = prescribed_.along(record.shape.line);
    if (record.shape.state == DropState::attached)
    {
        const Vector3 normal = wall_->at(centroid).normal;
        if (const auto profiles = profilesOf(drop, centroid, normal))
        {
            const double weight = length(gravity_);
            const Vector3 up = ((profiles->hangs ? 1 : -1)/weight)*gravity_;
            if (const auto& fit = profiles->fitted)
            {
                record.capillaryLength = fit->capillaryLength;
                record.sigma = density_*weight*std::pow(fit->capillaryLength, 2);
                if (const auto foot = footOf(*fit, centroid, up, *wall_))
                {
                    record.profileRadius = foot->radius;
                    record.profileAngle = foot->angle;
                }
            }
            if (const auto& fit = profiles->ofTheLiquid)
            {
                if (const auto foot = footOf(*fit, centroid, up, *wall_)) record.underGravity = {foot->angle, foot->radius, fit->rms/spacing_};
            }
        }
    }
    record.chosen = chosenAngle(record);
    return record;
}

// Of a drop that stands or hangs upright: with gravity along the axis it is axisymmetric.
std::optional<DropMeasurement::Profiles> DropMeasurement::profilesOf(const Drop& drop, const Vector3& centroid, const Vector3& normal) const
{
    constexpr double upright = 0.9998;          // cosine of one degree
    if (length(gravity_) == 0) return std::nullopt;
    Profiles profiles;
    profiles.hangs = dot(gravity_, normal) > 0;
    const Vector3 up = (profiles.hangs ? 1 : -1)*normalized(gravity_);       // off the wall
    if (dot(up, normal) < upright) return std::nullopt;

    const std::vector<double> areas = drop.surface.vertexAreas();
    std::vector<MeridianPoint> points;
    for (std::size_t i = 0; i < areas.size(); ++i)
    {
        const Vector3& x = drop.surface.vertices[i];
        if (wall_->at(x).distance <= controls_.limits.fitAbove*spacing_) continue;
        const double height = dot(x - centroid, up);
        points.push_back({length(x - centroid - height*up), height, areas[i]});
    }
    profiles.fitted = fitProfile(points, profiles.hangs);
    const double known = std::sqrt(tension_/(density_*length(gravity_)));
    if (known > 0 && std::isfinite(known)) profiles.ofTheLiquid = fitProfile(points, profiles.hangs, known);
    return profiles;
}

}
