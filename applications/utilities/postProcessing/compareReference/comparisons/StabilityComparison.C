// SPDX-License-Identifier: GPL-3.0-or-later
// type stability;  [theta 60;]
// What tells a calm run from one that went wrong, at the latest time; nothing of it is judged here:
//     particles that are no numbers
//     rms speed, over the last tenth of the run, in capillary speeds sqrt(sigma/(rho R)), R that of a sphere of the volume
//     stray particles [%]: without a neighbour within two spacings
//     particles behind the walls [%]: by more than half a spacing
//     the median distance to the nearest neighbour, in spacings
//     volume of the particles, as rule `volume` has it
//     contact angle of the largest drop that probeAngle found (0 for a film, 180 off the wall) against theta [degrees]; nan
//     where it found none
//     height of that drop over R, against the profile of Bashforth and Adams of its volume
// Numbers that cannot be had are nan.

#include "Comparison.H"
#include "LargestDrops.H"
#include "caseFiles/WallShape.H"
#include "core/fieldFile/FieldFile.H"
#include "meshes/NearestPoint.H"
#include "reference/BashforthAdams.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shizuku
{

namespace
{

constexpr double none = std::numeric_limits<double>::quiet_NaN();

bool finite(const Vector3& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }

// Distance of each to its nearest neighbour, sorted.
std::vector<double> nearestDistances(const std::vector<Vector3>& positions)
{
    std::vector<double> distances;
    if (positions.size() < 2) return distances;
    const NearestPoint nearest(positions);
    for (const Vector3& x : positions) distances.push_back(length(x - positions[nearest(x, 2).back()]));
    std::sort(distances.begin(), distances.end());
    return distances;
}

double percentBehind(const CaseResults& results, const std::vector<Vector3>& positions)
{
    const CaseWalls walls = readCaseWalls(results.casePath());
    std::vector<std::unique_ptr<WallShape>> shapes;
    for (const std::string& name : walls.names) shapes.push_back(makeWallShape(walls, name, results.spacing));
    const auto behind = [&](const Vector3& x)
    {
        const auto holds = [&](const auto& shape) { return shape->at(x).distance < -0.5*results.spacing; };
        return std::any_of(shapes.begin(), shapes.end(), holds);
    };
    return 100*double(std::count_if(positions.begin(), positions.end(), behind))/double(positions.size());
}

double rmsSpeed(const CsvTable& states, double mass)
{
    const double end = states.number(states.rows() - 1, "time");
    double sum = 0;
    long count = 0;
    for (std::size_t row = 0; row < states.rows(); ++row)
    {
        if (states.number(row, "time") < 0.9*end) continue;
        sum += std::sqrt(2*states.number(row, "kineticEnergy")/mass);
        ++count;
    }
    return sum/double(count);
}

// m; of the drop at rest.
double heightOf(const CaseResults& results, double theta)
{
    if (theta == 0 || results.sigma == 0) return none;
    const double l = results.gravity > 0 ? std::sqrt(results.sigma/(results.rho*results.gravity)) : HUGE_VAL;
    return bashforthAdamsOfVolume(results.liquidVolume(), l, theta).height();
}

}

class StabilityComparison : public Comparison
{
public:
    explicit StabilityComparison(const Dictionary& dict) : theta_(dict.lookupOr("theta", none)) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        std::vector<Vector3> positions = results.positions(results.times().back());
        const auto bad = std::erase_if(positions, [](const Vector3& x) { return !finite(x); });
        const std::vector<double> distances = nearestDistances(positions);
        const double median = distances.empty() ? none : distances[distances.size()/2];
        const auto strays = std::count_if(distances.begin(), distances.end(), [&](double r) { return r > 2*results.spacing; });
        const CsvTable states = results.table("drop", "liquidState.csv");
        const double mass = results.rho*results.liquidVolume();
        const double speed = results.sigma > 0 ? rmsSpeed(states, mass)/results.capillarySpeed() : none;

        std::vector<ComparisonRow> rows
        {
            absoluteRow("particles that are no numbers", "", 0, double(bad), none),
            absoluteRow("rms speed over capillary speed", "", 0, speed, none),
            absoluteRow("stray particles", "%", 0, 100*double(strays)/double(distances.size()), none),
            absoluteRow("particles behind the walls", "%", 0, percentBehind(results, positions), none),
            absoluteRow("distance to the nearest", "spacings", 1, median/results.spacing, none),
            relativeRow
            (
                "volume of the particles", "m3", results.liquidVolume(), states.number(states.rows() - 1, "volume"), none
            )
        };
        if (std::isnan(theta_)) return rows;
        const auto drops = LargestDrops::find(results);
        const double angle = drops ? drops->angle(drops->last()) : none;
        const double height = drops ? drops->number(drops->last(), "height") : none, R = results.radius();
        rows.push_back(absoluteRow("contact angle", "deg", theta_, angle, none));
        rows.push_back(absoluteRow("height over R", "", heightOf(results, theta_)/R, height/R, none));
        return rows;
    }

private:
    double theta_;
};

static const ComparisonTable::Add<StabilityComparison> registered{"stability"};

}
