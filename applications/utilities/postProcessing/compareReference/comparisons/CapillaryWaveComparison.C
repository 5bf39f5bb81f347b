// SPDX-License-Identifier: GPL-3.0-or-later
// type capillaryWave;  wavelength 4e-3;  depth 2e-3;  amplitude 1e-4;  within 3;
// A standing wave along x on a layer of that depth [m] in a box half a wavelength wide, from rest: its amplitude over that at the start [m] against
// Prosperetti 1981 (reference/CapillaryWave.H), rms over the written times, in percent of the amplitude at the start. Told besides: the time of
// the first zero. wave.csv holds the trace.

#include "Comparison.H"
#include "CosineMoment.H"
#include "reference/CapillaryWave.H"

#include <cmath>
#include <numbers>

namespace shizuku
{

namespace
{

// Straight between the points; NaN where there is none.
double firstZero(const std::vector<double>& t, const std::vector<double>& y)
{
    for (std::size_t i = 1; i < t.size(); ++i)
    {
        if (y[i] <= 0) return t[i - 1] + y[i - 1]/(y[i - 1] - y[i])*(t[i] - t[i - 1]);
    }
    return std::nan("");
}

}

class CapillaryWaveComparison : public JudgedComparison
{
public:
    explicit CapillaryWaveComparison(const Dictionary& dict)
    :
        JudgedComparison(dict), wavelength_(dict.lookupPositive("wavelength", dimensions::length)), depth_(dict.lookupPositive("depth", dimensions::length)),
        amplitude_(dict.lookupPositive("amplitude", dimensions::length))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const double k = 2*std::numbers::pi/wavelength_;
        const CapillaryWave wave{k, results.nu, results.sigma, results.rho, 0};
        const WaveTrace trace = cosineMoments(results, 0, k);
        CsvFile file = results.output("wave.csv", {{"time", "s"}, {"amplitude", ""}, {"exactAmplitude", ""}});
        std::vector<double> measured, exact;
        double sum = 0;
        for (std::size_t i = 0; i < trace.time.size(); ++i)
        {
            measured.push_back(2*depth_*trace.moment[i]/amplitude_);
            exact.push_back(wave.amplitude(trace.time[i]));
            sum += std::pow(measured.back() - exact.back(), 2);
            file.addRow({trace.time[i], measured.back(), exact.back()});
        }
        file.write();
        const double rms = 100*std::sqrt(sum/double(measured.size()));
        return
        {
            {"rms difference of the wave", "%", 0, rms, rms, "%", within_},
            relativeRow("first zero", "s", firstZero(trace.time, exact), firstZero(trace.time, measured), std::nan("")),
            {"amplitude at the start", "", 1, measured.front(), 100*(measured.front() - 1), "%", std::nan("")}
        };
    }

private:
    double wavelength_, depth_, amplitude_;
};

static const ComparisonTable::Add<CapillaryWaveComparison> registered{"capillaryWave"};

}
