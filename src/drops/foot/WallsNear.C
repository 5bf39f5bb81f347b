// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/foot/WallsNear.H"

#include "core/dictionary/Dictionary.H"
#include "core/time/Time.H"
#include "thetaModels/ThetaField.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

constexpr double neutral = 90;              // degrees: the free face meets the wall as it would its mirror image

}

WallsNear::WallsNear(const std::filesystem::path& casePath, double spacing) : case_(casePath), spacing_(spacing)
{
    if (!std::filesystem::exists(casePath/"constant/walls") && !haveSolidParticles(casePath)) return;
    walls_ = readCaseWalls(casePath);
    analytic_ = walls_.analytic;
    if (walls_.solid.positions.empty()) return;
    nearest_ = std::make_unique<NearestPoint>(walls_.solid.positions);
    std::vector<bool> used(walls_.solid.patches.size(), false);
    for (const int patch : walls_.solid.patch) used[patch] = true;
    for (std::size_t p = 0; p < used.size(); ++p)
    {
        shapes_.push_back(used[p] ? makeWallShape(walls_, walls_.solid.patches[p], spacing) : nullptr);
    }
}

void WallsNear::readTheta(double time)
{
    const auto file = case_/"constant/wettability";
    analyticTheta_.assign(analytic_.size(), neutral);
    if (std::filesystem::exists(file))
    {
        const Dictionary wettability = Dictionary::read(file);
        for (std::size_t i = 0; i < analytic_.size(); ++i)
        {
            if (wettability.found(analytic_[i].name)) analyticTheta_[i] = wallTheta(wettability, analytic_[i].name, case_);
        }
    }
    theta_.clear();
    if (!nearest_) return;
    const auto instance = findInstance(case_, time, "solid/theta");
    if (!instance.empty()) theta_ = shizuku::readTheta(instance, walls_.solid.positions.size());
}

std::optional<WallsNear::Wall> WallsNear::at(const Vector3& x, double reach) const
{
    std::optional<Wall> found;
    double closest = reach;
    const auto consider = [&](double height, const Vector3& normal, double theta)
    {
        if (std::abs(height) > closest) return;
        closest = std::abs(height);
        found = {height, normal, theta};
    };
    for (std::size_t i = 0; i < analytic_.size(); ++i)
    {
        const double height = analytic_[i].signedDistance(x);
        if (std::abs(height) <= closest) consider(height, analytic_[i].normal(x), analyticTheta_[i]);
    }
    if (!nearest_) return found;
    // Solid particles lie half a spacing inside of the solid.
    const auto k = nearest_->within(x, std::hypot(0.5*spacing_ + closest, 1.5*spacing_));
    if (!k) return found;
    const Vector3 r = x - walls_.solid.positions[*k];
    const double along = dot(r, walls_.solid.normals[*k]);
    if (squaredLength(r) - along*along > 2.25*spacing_*spacing_) return found;
    const WallPoint wall = shapes_[walls_.solid.patch[*k]]->at(x);
    consider(wall.distance, wall.normal, theta_.empty() ? neutral : theta_[*k]);
    return found;
}

}
