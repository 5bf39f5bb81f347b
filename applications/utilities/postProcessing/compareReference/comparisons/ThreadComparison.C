// SPDX-License-Identifier: GPL-3.0-or-later
// type thread;  radius 5e-4;  kR 0.697;  within 10;
// A thread of that mean radius [m] along z that begins at rest as R (1 + e cos(k z)), z from 0 on, between planes half a wavelength apart, or
// between cyclic sides a wavelength apart: the rate in e cosh(rate t) against Rayleigh's (reference/CapillaryWave.H), in percent, by least
// squares up to where the wave is a quarter of the radius high. thread.csv holds the trace.

#include "Comparison.H"
#include "CosineMoment.H"
#include "reference/CapillaryWave.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

struct Growth
{
    double start, rate;
};

// Of y = start cosh(rate t), by the rates up to four times the expected one.
Growth fitGrowth(const std::vector<double>& t, const std::vector<double>& y, double expected)
{
    Growth best{std::nan(""), std::nan("")};
    double least = std::numeric_limits<double>::infinity();
    for (int i = 1; i <= 4000; ++i)
    {
        const double rate = 1e-3*i*expected;
        double yc = 0, cc = 0, sum = 0;
        for (std::size_t j = 0; j < t.size(); ++j)
        {
            yc += y[j]*std::cosh(rate*t[j]);
            cc += std::pow(std::cosh(rate*t[j]), 2);
        }
        for (std::size_t j = 0; j < t.size(); ++j) sum += std::pow(y[j] - yc/cc*std::cosh(rate*t[j]), 2);
        if (!(sum < least)) continue;
        least = sum;
        best = {yc/cc, rate};
    }
    return best;
}

}

class ThreadComparison : public JudgedComparison
{
public:
    explicit ThreadComparison(const Dictionary& dict)
    :
        JudgedComparison(dict), radius_(dict.lookupPositive("radius", dimensions::length)), kR_(dict.lookupPositive("kR", dimensions::none))
    {
        if (kR_ >= 1) throw FatalInputError(dict.where("kR"), "A thread that short does not break", "kR below 1");
    }

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        constexpr double highest = 0.25;
        const double expected = threadGrowth(kR_, results.sigma, results.rho, radius_), none = std::nan("");
        WaveTrace trace = cosineMoments(results, 2, kR_/radius_);
        const bool grown = *std::max_element(trace.moment.begin(), trace.moment.end()) > highest;
        const auto count = std::find_if(trace.moment.begin(), trace.moment.end(), [](double e) { return e > highest; }) - trace.moment.begin();
        trace.time.resize(std::size_t(count));
        trace.moment.resize(std::size_t(count));
        const Growth growth = grown && count > 3 ? fitGrowth(trace.time, trace.moment, expected) : Growth{none, none};

        CsvFile file = results.output("thread.csv", {{"time", "s"}, {"height", "radii"}, {"fit", "radii"}});
        for (std::size_t i = 0; i < trace.time.size(); ++i)
        {
            file.addRow({trace.time[i], trace.moment[i], growth.start*std::cosh(growth.rate*trace.time[i])});
        }
        file.write();
        return {relativeRow("growth rate", "1/s", expected, growth.rate, within_), {"wave at the start", "radii", none, growth.start, none, "", none}};
    }

private:
    double radius_, kR_;
};

static const ComparisonTable::Add<ThreadComparison> registered{"thread"};

}
