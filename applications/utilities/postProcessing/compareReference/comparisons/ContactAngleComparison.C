// SPDX-License-Identifier: GPL-3.0-or-later
// type contactAngle;  theta 60;  [within 3;]  [times 3;]
// The apparent angle that probeAngle measured, mean of the last `times` written times, against theta [degrees]; what
// the angle changed over those times; contact radius and height against the spherical cap of the liquid's volume, for
// information. theta = 0 asks for a film, no thicker than `within` spacings and without gaps (one piece of liquid);
// theta = 180 for a drop that has left the wall. Without `within` the angle or the film's thickness is told, not judged.

#include "Comparison.H"
#include "LargestDrops.H"
#include "reference/BashforthAdams.H"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shizuku
{

class ContactAngleComparison : public Comparison
{
public:
    explicit ContactAngleComparison(const Dictionary& dict)
    :
        theta_(dict.lookup<double>("theta")),
        within_(dict.found("within") ? dict.lookupPositive("within", dimensions::none) : none),
        times_(dict.lookupOr("times", 3))
    {
        if (!(theta_ >= 0 && theta_ <= 180)) throw FatalInputError(dict.where("theta"), "theta is out of range", "0 to 180");
        if (times_ < 1) throw FatalInputError(dict.where("times"), "times is not positive", "1 or more");
    }

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const LargestDrops drops = LargestDrops::read(results);
        if (theta_ == 0) return film(drops, results);
        if (theta_ == 180) return liftOff(drops);
        return cap(drops, results);
    }

private:
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();

    std::vector<ComparisonRow> film(const LargestDrops& drops, const CaseResults& results) const
    {
        const double height = drops.number(drops.last(), "height")/results.spacing;
        return
        {
            {"height of the film", "spacings", 1, height, height, "spacings", within_},
            absoluteRow("pieces of the film", "", 1, drops.piecesAtLast(), 0)
        };
    }

    std::vector<ComparisonRow> liftOff(const LargestDrops& drops) const
    {
        const bool off = drops.state(drops.last()) == "detached";
        return {absoluteRow("off the wall", "", 1, off ? 1 : 0, 0)};
    }

    std::vector<ComparisonRow> cap(const LargestDrops& drops, const CaseResults& results) const
    {
        const std::size_t last = drops.last(), count = std::min(std::size_t(times_), drops.times());
        double angle = 0, low = 180, high = 0;
        for (std::size_t time = drops.times() - count; time <= last; ++time)
        {
            const double value = drops.angle(time);
            angle += value/double(count);
            low = std::min(low, value);
            high = std::max(high, value);
        }
        const DropProfile exact = bashforthAdamsOfVolume(results.liquidVolume(), HUGE_VAL, theta_, 2);
        return
        {
            absoluteRow("contact angle", "deg", theta_, angle, within_),
            absoluteRow("range of the last angles", "deg", 0, high - low, none),
            relativeRow("contact radius", "m", exact.contactRadius(), drops.number(last, "contactRadius"), none),
            relativeRow("height", "m", exact.height(), drops.number(last, "height"), none)
        };
    }

    double theta_, within_;
    int times_;
};

static const ComparisonTable::Add<ContactAngleComparison> registered{"contactAngle"};

}
