// SPDX-License-Identifier: GPL-3.0-or-later
// type damBreak;  width 57.15e-3;  within 5;
// The front of a column of water of that width [m] that collapses along x from x = 0, against Martin and Moyce 1952, in
// percent: the rms of the relative difference at their times within the run, up to where they stand four widths out; with the run begun
// as late as their liquid (reference/DamBreak.H), and for comparison at once. The front is the foremost particle that has nineteen before it,
// so that spray does not count. front.csv holds the trace.

#include "Comparison.H"
#include "reference/DamBreak.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

class DamBreakComparison : public JudgedComparison
{
public:
    explicit DamBreakComparison(const Dictionary& dict)
    : JudgedComparison(dict), width_(dict.lookupPositive("width", dimensions::length)) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        CsvFile trace = results.output("front.csv", {{"time", ""}, {"front", ""}, {"measured", ""}});
        const double none = std::nan("");
        std::vector<DamBreakFront> front;
        for (const TimeFolder& time : results.times())
        {
            front.push_back({time.value*std::sqrt(2*results.gravity/width_), position(results, time)/width_});
            trace.addRow({front.back().time + martinMoyceDelay, front.back().position, none});
        }
        for (const DamBreakFront& measured : martinMoyce1952()) trace.addRow({measured.time, none, measured.position});
        trace.write();

        const Difference late = difference(front, martinMoyceDelay), atOnce = difference(front, 0);
        return
        {
            {"rms difference of the front", "%", 0, late.rms, late.rms, "%", within_},
            relativeRow("last front compared", "widths", late.lastMeasured, late.last, none),
            {"rms difference of the front begun at once", "%", 0, atOnce.rms, atOnce.rms, "%", none}
        };
    }

private:
    struct Difference
    {
        double rms, last, lastMeasured;                 // percent, widths
    };

    // Of fronts that begin `delay` after the experiment's clock.
    static Difference difference(const std::vector<DamBreakFront>& front, double delay)
    {
        const double none = std::nan("");
        Difference result{none, none, none};
        double sum = 0;
        int count = 0;
        for (const DamBreakFront& measured : martinMoyce1952())
        {
            const double time = measured.time - delay;
            if (time > front.back().time || measured.position > 4.2) continue;
            const auto after = std::find_if(front.begin() + 1, front.end(), [&](const DamBreakFront& at) { return at.time >= time; });
            const auto before = after - 1;
            result.last = before->position + (after->position - before->position)*(time - before->time)/(after->time - before->time);
            result.lastMeasured = measured.position;
            sum += std::pow(result.last/measured.position - 1, 2);
            result.rms = 100*std::sqrt(sum/++count);
        }
        return result;
    }

    static double position(const CaseResults& results, const TimeFolder& time)
    {
        constexpr std::size_t spray = 20;
        std::vector<double> x;
        for (const Vector3& each : results.positions(time)) x.push_back(each.x);
        const auto place = x.end() - std::min<long>(spray, long(x.size()));
        std::nth_element(x.begin(), place, x.end());
        return *place + 0.5*results.spacing;
    }

    double width_;
};

static const ComparisonTable::Add<DamBreakComparison> registered{"damBreak"};

}
