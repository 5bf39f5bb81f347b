// SPDX-License-Identifier: GPL-3.0-or-later
#include "reference/DropOscillation.H"

#include "maths/LinearSolve.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

namespace
{

// Mean, cosine and sine by linear least squares where frequency and damping are given.
std::optional<DampedOscillation> linearFit
(
    const std::vector<double>& t, const std::vector<double>& y, double frequency, double damping
)
{
    NormalEquations<3> equations;
    for (std::size_t i = 0; i < t.size(); ++i)
    {
        const double decay = std::exp(-damping*t[i]);
        equations.add({1, decay*std::cos(frequency*t[i]), decay*std::sin(frequency*t[i])}, y[i]);
    }
    const auto solution = equations.solve();
    if (!solution) return std::nullopt;

    DampedOscillation fit{frequency, damping, (*solution)[0], (*solution)[1], (*solution)[2]};
    for (std::size_t i = 0; i < t.size(); ++i) fit.rms += std::pow(y[i] - fit.at(t[i]), 2);
    fit.rms = std::sqrt(fit.rms/double(t.size()));
    return fit;
}

}

double dropFrequency(int mode, double sigma, double rho, double radius)
{
    return std::sqrt(mode*(mode - 1.0)*(mode + 2)*sigma/(rho*std::pow(radius, 3)));
}

double dropDamping(int mode, double nu, double radius)
{
    return (mode - 1.0)*(2*mode + 1)*nu/(radius*radius);
}

double DampedOscillation::at(double t) const
{
    return mean + std::exp(-damping*t)*(cosine*std::cos(frequency*t) + sine*std::sin(frequency*t));
}

std::optional<DampedOscillation> fitDampedOscillation
(
    const std::vector<double>& t, const std::vector<double>& y, double expected
)
{
    constexpr std::size_t fewest = 8;       // five unknowns
    if (t.size() < fewest || t.size() != y.size()) return std::nullopt;

    // The best of a net over frequency and damping, then of ever finer nets around it: the residual has many valleys
    // along the frequency, as wide as 1/(length of the trace).
    std::optional<DampedOscillation> best;
    const auto tryOne = [&](double frequency, double damping)
    {
        const auto fit = linearFit(t, y, frequency, damping);
        if (fit && (!best || fit->rms < best->rms)) best = fit;
    };
    const double length = t.back() - t.front();
    const int steps = std::clamp(int(20*expected*length), 50, 5000);
    for (int i = 0; i <= steps; ++i)
    {
        for (const double damping : {0.0, 0.02, 0.05, 0.1, 0.2, 0.5}) tryOne(expected*(0.5 + 1.5*i/steps), damping*expected);
    }
    if (!best) return std::nullopt;
    double widthOfFrequency = 1.5*expected/steps, widthOfDamping = 0.3*expected;
    while (widthOfFrequency > 1e-9*expected)
    {
        const DampedOscillation centre = *best;
        for (int i = -4; i <= 4; ++i)
        {
            for (int j = -4; j <= 4; ++j)
            {
                tryOne(centre.frequency + i*widthOfFrequency/4, centre.damping + j*widthOfDamping/4);
            }
        }
        widthOfFrequency *= 0.6;
        widthOfDamping *= 0.6;
    }
    const double edge = 1e-3*expected;
    if (best->frequency < 0.5*expected + edge || best->frequency > 2*expected - edge) return std::nullopt;
    return best;
}

std::optional<DampedOscillation> fitDecay
(
    const std::vector<double>& t, const std::vector<double>& y, double frequency, double expectedDamping
)
{
    constexpr std::size_t fewest = 6;       // four unknowns
    if (t.size() < fewest || t.size() != y.size()) return std::nullopt;

    constexpr int steps = 60;
    std::optional<DampedOscillation> best;
    const auto tryOne = [&](double damping)
    {
        const auto fit = linearFit(t, y, frequency, damping);
        if (fit && (!best || fit->rms < best->rms)) best = fit;
    };
    const double least = expectedDamping/5, most = 5*expectedDamping;
    double ratio = std::pow(most/least, 1.0/steps);
    for (int i = 0; i <= steps; ++i) tryOne(least*std::pow(ratio, i));
    if (!best) return std::nullopt;
    for (; ratio > 1 + 1e-9; ratio = std::sqrt(ratio))
    {
        const double centre = best->damping;
        tryOne(centre*ratio);
        tryOne(centre/ratio);
    }
    if (best->damping < 1.01*least || best->damping > 0.99*most) return std::nullopt;
    return best;
}

}
