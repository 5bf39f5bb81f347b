// SPDX-License-Identifier: GPL-3.0-or-later
// type capillaryRise;  radius 1e-3;  outer 1.7e-3;  dish 3.5e-3;  mouth 1.2e-3;  theta 30;  within 5;
// Liquid that rises from rest in an upright tube about the z axis, of that inner and outer radius [m], whose mouth is that high [m] above the floor z = 0 of a
// round dish [m], or of a pool that reservoirs keep at a level above it (`level 2.4e-3;` in place of `dish`): the mean level in the tube, by the particles
// there, over where both levels would be equal; or between plates half a gap of `radius` from the plane of symmetry x = 0, of that width [m] along y, in such a pool; against reference/CapillaryRise.H; rms over the written times, in percent of Jurin's height. Told besides: the
// largest and the last height, and the difference from a contact line that moves with the angle of Cox and Voinov and slips over a spacing. rise.csv holds the trace.

#include "Comparison.H"
#include "reference/CapillaryRise.H"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace shizuku
{

class CapillaryRiseComparison : public JudgedComparison
{
public:
    explicit CapillaryRiseComparison(const Dictionary& dict)
    :
        JudgedComparison(dict),
        radius_(dict.lookupPositive("radius", dimensions::length)),
        mouth_(dict.lookupPositive("mouth", dimensions::length)),
        theta_(dict.lookup<double>("theta"))
    {
        if (dict.found("width")) readPlates(dict);
        else readTube(dict);
        if (level_ && !(*level_ > mouth_)) throw FatalInputError(dict.where("level"), "The mouth is not in the pool", "a level above the mouth");
    }

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const double within = width_ ? radius_ * *width_ : section(radius_);
        CapillaryRise rise{radius_, theta_, results.rho, results.nu, results.sigma, results.gravity, 0};
        rise.isBetweenPlates = width_.has_value();
        rise.entry = entry_.value_or(rise.entry);
        rise.entryFriction = entryFriction_.value_or(rise.entryFriction);
        rise.immersion = level_.value_or(mouth_) - mouth_;
        if (dish_)
        {
            const double around = section(*dish_) - section(*outer_);
            rise.immersion = (results.liquidVolume() - section(*dish_)*mouth_)/(within + around);
            rise.areaRatio = within/around;
        }

        std::vector<double> times, measured;
        for (const TimeFolder& time : results.times())
        {
            const std::vector<Vector3> x = results.positions(time);
            const auto rose = std::count_if(x.begin(), x.end(), [&](const Vector3& at) { return at.z > mouth_ && std::hypot(at.x, width_ ? 0 : at.y) < radius_; });
            times.push_back(time.value);
            measured.push_back(double(rose)*results.particleVolume()/within - rise.immersion);
        }
        const std::vector<double> exact = rise.heights(measured.front(), times);
        rise.slipLength = results.spacing;
        const std::vector<double> moving = rise.heights(measured.front(), times);

        CsvFile trace = results.output("rise.csv", {{"time", "s"}, {"height", "m"}, {"exactHeight", "m"}, {"withMovingAngle", "m"}});
        for (std::size_t i = 0; i < times.size(); ++i) trace.addRow({times[i], measured[i], exact[i], moving[i]});
        trace.write();
        const auto rms = [&](const std::vector<double>& reference)
        {
            double sum = 0;
            for (std::size_t i = 0; i < times.size(); ++i) sum += std::pow(measured[i] - reference[i], 2);
            return 100*std::sqrt(sum/double(times.size()))/rise.finalHeight();
        };
        const double none = std::nan("");
        return
        {
            {"rms difference of the rise", "%", 0, rms(exact), rms(exact), "%", within_},
            {"rms difference with a moving angle", "%", 0, rms(moving), rms(moving), "%", none},
            relativeRow("largest height", "m", *std::max_element(exact.begin(), exact.end()), *std::max_element(measured.begin(), measured.end()), none),
            relativeRow("last height", "m", exact.back(), measured.back(), none)
        };
    }

private:
    void readTube(const Dictionary& dict)
    {
        outer_ = dict.lookupPositive("outer", dimensions::length);
        if (dict.found("level")) level_ = dict.lookupPositive("level", dimensions::length);
        else dish_ = dict.lookupPositive("dish", dimensions::length);
        if (!(radius_ < *outer_ && (level_ || *outer_ < *dish_))) throw FatalInputError(dict.where("outer"), "The tube does not fit into the dish", "radius < outer < dish");
    }

    void readPlates(const Dictionary& dict)
    {
        width_ = dict.lookupPositive("width", dimensions::length);
        level_ = dict.lookupPositive("level", dimensions::length);
        entry_ = dict.lookupPositive("entry", dimensions::none, true);
        entryFriction_ = dict.lookupPositive("entryFriction", dimensions::none, true);
    }

    static double section(double radius) { return std::numbers::pi*radius*radius; }

    double radius_, mouth_, theta_;
    std::optional<double> outer_;               // of a tube
    std::optional<double> dish_, level_;        // one of them
    std::optional<double> width_, entry_, entryFriction_;       // of plates
};

static const ComparisonTable::Add<CapillaryRiseComparison> registered{"capillaryRise"};

}
