// SPDX-License-Identifier: GPL-3.0-or-later
// type oscillation;  within 2;  dampingWithin 20;
// The period in which a free drop swings in mode 2 against that of a drop of its viscosity, in percent; so its damping, for information where
// dampingWithin is left out. The swing is read off the particles' second moments along z and across,
//     q = (M_zz - (M_xx + M_yy)/2)/(M_xx + M_yy + M_zz),
// linear in a small amplitude, and fitted by a damped oscillation. The trace is written to oscillation.csv.

#include "Comparison.H"
#include "core/fieldFile/CsvFile.H"
#include "reference/DropOscillation.H"
#include "reference/ViscousDrop.H"

#include <cmath>
#include <numbers>

namespace shizuku
{

namespace
{

double elongation(const std::vector<Vector3>& positions)
{
    Vector3 centre{0, 0, 0};
    for (const Vector3& x : positions) centre = centre + (1.0/double(positions.size()))*x;
    double across = 0, along = 0;
    for (const Vector3& x : positions)
    {
        const Vector3 r = x - centre;
        across += r.x*r.x + r.y*r.y;
        along += r.z*r.z;
    }
    return (along - across/2)/(along + across);
}

}

class OscillationComparison : public Comparison
{
public:
    explicit OscillationComparison(const Dictionary& dict)
    :
        within_(dict.lookupPositive("within", dimensions::none)),
        dampingWithin_(dict.found("dampingWithin") ? dict.lookupPositive("dampingWithin", dimensions::none) : std::nan(""))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        constexpr int mode = 2;
        std::vector<double> t, q;
        for (const TimeFolder& time : results.times())
        {
            t.push_back(time.value);
            q.push_back(elongation(results.positions(time)));
        }
        const double radius = results.radius(), inviscid = dropFrequency(mode, results.sigma, results.rho, radius);
        const DropMode exact = results.nu > 0
          ? viscousDropMode(mode, results.nu, results.sigma, results.rho, radius) : DropMode{0, inviscid};
        const auto fit = fitDampedOscillation(t, q, exact.frequency > 0 ? exact.frequency : inviscid);
        const double none = std::nan("");
        const double period = 2*std::numbers::pi/exact.frequency;          // infinite where it creeps

        CsvFile trace
        (
            results.casePath()/"postProcessing/compareReference/oscillation.csv",
            {{"time", "s"}, {"elongation", ""}, {"fit", ""}, {"period", "s"}}
        );
        for (std::size_t i = 0; i < t.size(); ++i) trace.addRow({t[i], q[i], fit ? fit->at(t[i]) : none, period});
        trace.write();

        return
        {
            relativeRow("period", "s", period, fit ? 2*std::numbers::pi/fit->frequency : none, within_),
            relativeRow("damping", "1/s", exact.damping, fit ? fit->damping : none, dampingWithin_)
        };
    }

private:
    double within_, dampingWithin_;
};

static const ComparisonTable::Add<OscillationComparison> registered{"oscillation"};

}
