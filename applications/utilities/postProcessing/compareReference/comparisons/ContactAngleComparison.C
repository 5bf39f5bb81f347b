// type contactAngle;  theta 60;  within 3;  [times 3;]
// The apparent angle that probeAngle measured, mean of the last `times` written times, against theta [degrees]; what
// the angle changed over those times; contact radius and height against the spherical cap of the liquid's volume, for
// information. theta = 0 asks for a film, no thicker than `within` spacings and without gaps (one piece of liquid);
// theta = 180 for a drop that has left the wall.

#include "Comparison.H"
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
        within_(dict.lookupPositive("within", dimensions::none)),
        times_(dict.lookupOr("times", 3))
    {
        if (!(theta_ >= 0 && theta_ <= 180)) throw FatalInputError(dict.where("theta"), "theta is out of range", "0 to 180");
        if (times_ < 1) throw FatalInputError(dict.where("times"), "times is not positive", "1 or more");
    }

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const CsvTable drops = results.table("probeAngle", "angle.csv");
        std::vector<std::size_t> rows;          // of the largest drop, the last times
        double lastTime = -1;
        for (std::size_t row = 0; row < drops.rows(); ++row)
        {
            const double time = drops.number(row, "time");
            if (time != lastTime) rows.push_back(row);
            else if (drops.number(row, "volume") > drops.number(rows.back(), "volume")) rows.back() = row;
            lastTime = time;
        }
        if (rows.empty()) throw FatalInputError({results.casePath().string(), 0}, "probeAngle found no drop");
        const std::size_t last = rows.back();
        if (theta_ == 0) return film(drops, last, results);
        if (theta_ == 180) return liftOff(drops, last);
        rows.erase(rows.begin(), rows.end() - std::min<long>(times_, long(rows.size())));
        return cap(drops, rows, results);
    }

private:
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();

    std::vector<ComparisonRow> film(const CsvTable& drops, std::size_t last, const CaseResults& results) const
    {
        const double height = drops.number(last, "height")/results.spacing;
        int pieces = 0;
        for (std::size_t row = 0; row < drops.rows(); ++row)
        {
            if (drops.text(row, "time") == drops.text(last, "time")) ++pieces;
        }
        return
        {
            {"height of the film", "spacings", 1, height, height, "spacings", within_},
            absoluteRow("pieces of the film", "", 1, pieces, 0)
        };
    }

    std::vector<ComparisonRow> liftOff(const CsvTable& drops, std::size_t last) const
    {
        const bool off = drops.text(last, "state") == "detached";
        return {absoluteRow("off the wall", "", 1, off ? 1 : 0, 0)};
    }

    std::vector<ComparisonRow> cap
    (
        const CsvTable& drops, const std::vector<std::size_t>& rows, const CaseResults& results
    ) const
    {
        double angle = 0, low = 180, high = 0;
        for (const std::size_t row : rows)
        {
            const std::string state = drops.text(row, "state");     // a film is read as 0 degrees, a drop off the wall as 180
            const double value = state == "film" ? 0 : state == "detached" ? 180 : drops.number(row, "angle");
            angle += value/double(rows.size());
            low = std::min(low, value);
            high = std::max(high, value);
        }
        const DropProfile exact = bashforthAdamsOfVolume(results.liquidVolume(), HUGE_VAL, theta_, 2);
        const std::size_t last = rows.back();
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
