// SPDX-License-Identifier: GPL-3.0-or-later
// type gravityDrop;  theta 60;  within 2;
// Height and contact radius of a drop on the wall z = 0 under gravity against the profile of Bashforth and Adams of its
// volume, in percent, and the surface tension by the profile that fits it best, which is asked of drops that are as large
// as the capillary length. Contact radius and angle are those of that profile where it meets the wall: the mesh's foot is
// rounded by 0.4 spacings, and tangents miss a puddle's rim, which bends within a few. Where no profile fits, the radius is
// that of the tangents. Of a drop that overhangs the largest radius as well, as it is seen from above. Measured on the mesh
// of the latest time. profile.csv holds the measured outline, radius by height, beside the exact one.

#include "Comparison.H"
#include "LargestDrops.H"
#include "core/angles/Degrees.H"
#include "reference/BashforthAdams.H"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shizuku
{

class GravityDropComparison : public JudgedComparison
{
public:
    explicit GravityDropComparison(const Dictionary& dict)
    : JudgedComparison(dict), theta_(dict.lookup<double>("theta")) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const double l = std::sqrt(results.sigma/(results.rho*results.gravity));
        const DropProfile exact = bashforthAdamsOfVolume(results.liquidVolume(), l, theta_);
        double widest = 0;
        for (const DropProfilePoint& point : exact.points) widest = std::max(widest, point.x);

        const LargestDrops drops = LargestDrops::read(results);
        const std::size_t last = drops.last();
        const double height = drops.number(last, "height");
        const double radius = std::sqrt(drops.number(last, "coveredArea")/std::numbers::pi);
        const double byProfile = drops.number(last, "profileRadius");
        const double contactRadius = std::isnan(byProfile) ? drops.number(last, "lineRadius") : byProfile;
        const double sigmaWithin = results.radius() > 0.99*l ? 3 : std::nan("");        // percent
        writeProfile(results, exact);
        return
        {
            relativeRow("height", "m", exact.height(), height, within_),
            relativeRow("contact radius", "m", exact.contactRadius(), contactRadius, within_),
            relativeRow("largest radius", "m", widest, radius, theta_ > 90 ? within_ : std::nan("")),
            relativeRow("surface tension", "N/m", results.sigma, drops.number(last, "sigma"), sigmaWithin),
            absoluteRow("contact angle by the profile", "deg", theta_, drops.number(last, "profileAngle"), std::nan("")),
            relativeRow("height of a puddle", "m", 2*l*std::sin(radians(theta_)/2), height, std::nan(""))
        };
    }

private:
    // Mean distance of the mesh's vertices from the drop's axis, in slices half a spacing thick, from one spacing above
    // the wall: below are the vertices of the drop's foot.
    static void writeProfile(const CaseResults& results, const DropProfile& exact)
    {
        const TriangleMesh mesh = results.surface(results.times().back());
        const Vector3 axis = mesh.centroid();
        std::vector<double> sum, count;
        for (const Vector3& x : mesh.vertices)
        {
            const long slice = long(std::floor(x.z/(0.5*results.spacing)));
            if (slice < 2) continue;
            if (std::size_t(slice) >= sum.size())
            {
                sum.resize(slice + 1);
                count.resize(slice + 1);
            }
            sum[slice] += std::hypot(x.x - axis.x, x.y - axis.y);
            ++count[slice];
        }
        const std::size_t rows = std::max(sum.size(), exact.points.size());
        const double none = std::nan("");
        CsvFile profile = results.output("profile.csv", {{"radius", "m"}, {"height", "m"}, {"exactRadius", "m"}, {"exactHeight", "m"}});
        for (std::size_t i = 0; i < rows; ++i)
        {
            const bool measured = i < sum.size() && count[i] > 0, known = i < exact.points.size();
            profile.addRow
            ({
                measured ? sum[i]/count[i] : none, measured ? (double(i) + 0.5)*0.5*results.spacing : none,
                known ? exact.points[i].x : none, known ? exact.height() - exact.points[i].z : none
            });
        }
        profile.write();
    }

    double theta_;
};

static const ComparisonTable::Add<GravityDropComparison> registered{"gravityDrop"};

}
