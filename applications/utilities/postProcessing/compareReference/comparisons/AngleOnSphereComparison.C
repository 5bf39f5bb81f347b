// type angleOnSphere;  centre (0 0 0);  radius 2e-3;  theta 60;  within 3;
// The angle at which a drop meets a solid sphere (centre, radius [m]) without gravity: a sphere of radius R is fitted to
// the vertices of the largest drop's mesh more than 1.25 spacings off the solid; with D between the centres, the surfaces
// cut each other at
//     cos(theta) = (R^2 + Rs^2 - D^2)/(2 R Rs).
// nan where the two do not meet.

#include "Comparison.H"
#include "geometry/SphereFit.H"
#include "geometry/drops/Drops.H"

#include <cmath>
#include <numbers>

namespace shizuku
{

class AngleOnSphereComparison : public Comparison
{
public:
    explicit AngleOnSphereComparison(const Dictionary& dict)
    :
        centre_(dict.lookupDimensionedVector("centre", dimensions::length)),
        radius_(dict.lookupPositive("radius", dimensions::length)),
        theta_(dict.lookup<double>("theta")),
        within_(dict.lookupPositive("within", dimensions::none))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        constexpr double fitAbove = 1.25;
        const auto drops = separateDrops(results.surface(results.times().back()), 20*results.particleVolume());
        std::vector<Vector3> points;
        for (const Vector3& x : drops.empty() ? std::vector<Vector3>{} : drops.front().surface.vertices)
        {
            if (length(x - centre_) > radius_ + fitAbove*results.spacing) points.push_back(x);
        }
        double angle = std::nan("");
        if (const auto fit = fitSphere(points))
        {
            const double distance = length(fit->centre - centre_);
            const double cosine =
                (fit->radius*fit->radius + radius_*radius_ - distance*distance)/(2*fit->radius*radius_);
            angle = std::acos(cosine)*180/std::numbers::pi;
        }
        return {absoluteRow("contact angle", "deg", theta_, angle, within_)};
    }

private:
    Vector3 centre_;
    double radius_, theta_, within_;
};

static const ComparisonTable::Add<AngleOnSphereComparison> registered{"angleOnSphere"};

}
