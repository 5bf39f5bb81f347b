// SPDX-License-Identifier: GPL-3.0-or-later
// type longThread;  radius 5e-4;  length 0.036;  within 10;
// A thread of that radius and length [m] along z from z = 0 on, between planes, that begins at rest with waves of many lengths: the mean of k R over its waves, each
// weighed by the square of its height, once the radius differs from its mean by a fifth, rms; against the same of waves that have grown from those at the start as
// long by Rayleigh's rates (reference/CapillaryWave.H), in percent. Waves of k R below 1, which grow, are looked at. And the mean distance of drops when there are most of them, later some merge, against
// the fastest wave's length: those at the planes counted as halves, those of less than a quarter of a wavelength's liquid not at all. spectrum.csv holds the heights of the waves, over the radius.

#include "Comparison.H"
#include "CosineMoment.H"
#include "drops/SeparateBodies.H"
#include "reference/CapillaryWave.H"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shizuku
{

class LongThreadComparison : public JudgedComparison
{
public:
    explicit LongThreadComparison(const Dictionary& dict)
    :
        JudgedComparison(dict),
        radius_(dict.lookupPositive("radius", dimensions::length)), length_(dict.lookupPositive("length", dimensions::length))
    {
        if (length_ < 2*std::numbers::pi*radius_) throw FatalInputError(dict.where("length"), "A thread that short does not break", "a length of 2 pi radii or more");
    }

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        constexpr double rough = 0.2;
        std::vector<Wave> waves;
        std::vector<double> squares(results.times().size());
        for (int m = 1; m*std::numbers::pi*radius_/length_ < 1; ++m)
        {
            const double k = m*std::numbers::pi/length_;
            waves.push_back({k*radius_, cosineMoments(results, 2, k)});
            for (std::size_t i = 0; i < squares.size(); ++i) squares[i] += std::pow(waves.back().trace.moment[i], 2);
        }
        const double none = std::nan("");
        double measured = none, expected = none, time = none, most = 0;
        for (std::size_t i = 0; i < squares.size(); ++i)
        {
            if (!std::isnan(time)) most = std::max(most, drops(results, results.times()[i]));
            if (!std::isnan(time) || squares[i] < 2*rough*rough) continue;
            time = waves.front().trace.time[i];
            const auto now = [&](const Wave& wave) { return wave.trace.moment[i]; };
            const auto grown = [&](const Wave& wave)
            {
                return wave.trace.moment.front()*std::cosh(threadGrowth(wave.kR, results.sigma, results.rho, radius_)*time);
            };
            measured = winner(waves, now);
            expected = winner(waves, grown);
            CsvFile spectrum = results.output("spectrum.csv", {{"kR", ""}, {"start", ""}, {"height", ""}, {"byRayleigh", ""}});
            for (const Wave& wave : waves) spectrum.addRow({wave.kR, std::abs(wave.trace.moment.front()), std::abs(now(wave)), std::abs(grown(wave))});
            spectrum.write();
        }
        return
        {
            relativeRow("k R of the waves that win", "", expected, measured, within_),
            {"time until then", "growth times", none, time*threadGrowth(fastest, results.sigma, results.rho, radius_), none, "", none},
            relativeRow("distance of the drops", "radii", 2*std::numbers::pi/fastest, most > 0 ? length_/radius_/most : none, within_)
        };
    }

private:
    static constexpr double fastest = 0.697;            // k R

    struct Wave
    {
        double kR;
        WaveTrace trace;
    };

    static double winner(const std::vector<Wave>& waves, const auto& height)
    {
        double sum = 0, weights = 0;
        for (const Wave& wave : waves)
        {
            sum += wave.kR*std::pow(height(wave), 2);
            weights += std::pow(height(wave), 2);
        }
        return sum/weights;
    }

    double drops(const CaseResults& results, const TimeFolder& time) const
    {
        const std::vector<Vector3> positions = results.positions(time);
        const double least = 0.25*std::numbers::pi*radius_*radius_*2*std::numbers::pi*radius_/fastest;
        double number = 0;
        for (const SeparateBody& body : separateBodies(positions, std::vector<Vector3>(positions.size()), results.spacing))
        {
            if (body.volume < least) continue;
            const bool low = body.low.z < 0.5*results.spacing, high = body.high.z > length_ - 0.5*results.spacing;
            number += low || high ? 0.5 : 1;
        }
        return number;
    }

    double radius_, length_;
};

static const ComparisonTable::Add<LongThreadComparison> registered{"longThread"};

}
