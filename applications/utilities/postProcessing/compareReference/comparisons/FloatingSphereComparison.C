// SPDX-License-Identifier: GPL-3.0-or-later
// type floatingSphere;  ball ball;  bath bath;  floor floor;  theta 60;  from 0.7;  within 3;  [function body;]
// A sphere that the liquid moves, at rest in the middle of an upright round bath whose wall has 90 degrees: the depth of its lowest point below the level against the exact meniscus, by the function object
// `sixDoFRigidBodyState`. Mean of the rows behind `from` of the run's time.

#include "Comparison.H"
#include "LastRows.H"
#include "caseFiles/AnalyticSurface.H"
#include "reference/SphereInBath.H"
#include "wallMotions/SixDoFBody.H"
#include "wallMotions/WallMotions.H"

#include <cmath>
#include <numbers>

namespace shizuku
{

class FloatingSphereComparison : public JudgedComparison
{
public:
    explicit FloatingSphereComparison(const Dictionary& dict)
    :
        JudgedComparison(dict), where_(dict.where()), ball_(dict.lookup<std::string>("ball")), bath_(dict.lookup<std::string>("bath")), floor_(dict.lookup<std::string>("floor")),
        function_(dict.lookupOr<std::string>("function", "body")), theta_(dict.lookupPositive("theta", dimensions::none)), from_(dict.lookupOr("from", 0.7))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        using Type = AnalyticSurface::Type;
        const auto surfaces = readAnalyticSurfaces(Dictionary::read(results.casePath()/"constant/walls"));
        const AnalyticSurface ball = named(surfaces, ball_, Type::sphere), bath = named(surfaces, bath_, Type::cylinder), floor = named(surfaces, floor_, Type::plane);
        const WallMotions motions = WallMotions::read(results.casePath());
        if (!motions.body()) throw FatalInputError(where_, "The liquid moves no body in this case", "a wall with a motion of type sixDoF");
        if (!(results.gravity > 0)) throw FatalInputError(where_, "The case has no gravity", "bodyForce gravity");
        const double load = motions.body()->mass()/results.rho;
        const SphereInBath exact(bath.radius, ball.radius, std::sqrt(results.sigma/(results.rho*results.gravity)), theta_);
        const double level = floor.point.z + (results.liquidVolume() + load)/(std::numbers::pi*bath.radius*bath.radius);
        return {relativeRow("depth of the sphere", "m", exact.depthUnder(load), level - height(results.table(function_, "sixDoFRigidBodyState.csv")) + ball.radius, within_)};
    }

private:
    AnalyticSurface named(const std::vector<AnalyticSurface>& surfaces, const std::string& name, AnalyticSurface::Type type) const
    {
        for (const AnalyticSurface& surface : surfaces) if (surface.name == name && surface.type == type) return surface;
        throw FatalInputError(where_, "constant/walls has no " + typeName(type) + " '" + name + "'", "an upright cylinder with a sphere in it on a level plane");
    }

    // Of the sphere's middle, m: the mean of the last rows.
    double height(const CsvTable& table) const
    {
        return meanOfLast(table, from_, [&](std::size_t row) { return table.number(row, "centreZ"); });
    }

    SourceLocation where_;
    std::string ball_, bath_, floor_, function_;
    double theta_, from_;
};

static const ComparisonTable::Add<FloatingSphereComparison> registered{"floatingSphere"};

}
