// SPDX-License-Identifier: GPL-3.0-or-later
// type oscillation;  within 2;  dampingWithin 20;  mode 2;
// The period in which a free drop swings in that mode about the z axis against that of a drop of its viscosity, in percent; so its damping,
// for information where dampingWithin is left out. The swing is read off the particles' moment of the mode's solid harmonic,
//     q = sum r^l P_l(z/r)/sum r^l,
// linear in a small amplitude, and fitted by a damped oscillation. A mode that is damped faster than it swings is not asked for its period:
// its decay is fitted from 1/damping on, when what started from rest has become the mode. The trace is written to oscillation.csv.

#include "Comparison.H"
#include "reference/DropOscillation.H"
#include "reference/ViscousDrop.H"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shizuku
{

namespace
{

double elongation(const std::vector<Vector3>& positions, int mode)
{
    const Vector3 centre = meanOf(positions);
    double moment = 0, size = 0;
    for (const Vector3& x : positions)
    {
        const double r = length(x - centre), power = std::pow(r, mode);
        if (r > 0) moment += power*std::legendre(unsigned(mode), std::clamp((x.z - centre.z)/r, -1.0, 1.0));
        size += power;
    }
    return moment/size;
}

}

class OscillationComparison : public JudgedComparison
{
public:
    explicit OscillationComparison(const Dictionary& dict)
    :
        JudgedComparison(dict), dampingWithin_(dict.found("dampingWithin") ? dict.lookupPositive("dampingWithin", dimensions::none) : std::nan("")),
        mode_(dict.lookupOr("mode", 2))
    {
        if (mode_ < 2 || mode_ > 8) throw FatalInputError(dict.where("mode"), "mode is out of range", "2 to 8");
    }

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        std::vector<double> t, q;
        for (const TimeFolder& time : results.times())
        {
            t.push_back(time.value);
            q.push_back(elongation(results.positions(time), mode_));
        }
        const double radius = results.radius(), inviscid = dropFrequency(mode_, results.sigma, results.rho, radius);
        const DropMode exact = results.nu > 0
          ? viscousDropMode(mode_, results.nu, results.sigma, results.rho, radius) : DropMode{0, inviscid};
        const bool swings = exact.frequency > exact.damping;
        const auto fit = swings ? fitDampedOscillation(t, q, exact.frequency) : fitLate(t, q, exact);
        const double none = std::nan("");
        const double period = 2*std::numbers::pi/exact.frequency;          // infinite where it creeps

        CsvFile trace = results.output("oscillation.csv", {{"time", "s"}, {"elongation", ""}, {"fit", ""}, {"period", "s"}});
        for (std::size_t i = 0; i < t.size(); ++i) trace.addRow({t[i], q[i], fit ? fit->at(t[i]) : none, period});
        trace.write();

        return
        {
            relativeRow("period", "s", period, fit && swings ? 2*std::numbers::pi/fit->frequency : none, swings ? within_ : none),
            relativeRow("damping", "1/s", exact.damping, fit ? fit->damping : none, dampingWithin_)
        };
    }

private:
    static std::optional<DampedOscillation> fitLate(const std::vector<double>& t, const std::vector<double>& q, const DropMode& exact)
    {
        const auto from = std::lower_bound(t.begin(), t.end(), 1/exact.damping) - t.begin();
        return fitDecay({t.begin() + from, t.end()}, {q.begin() + from, q.end()}, exact.frequency, exact.damping);
    }

    double dampingWithin_;
    int mode_;
};

static const ComparisonTable::Add<OscillationComparison> registered{"oscillation"};

}
