// type damBreak;  width 57.15e-3;  within 5;
// The front of a column of water of that width [m] that collapses along x from x = 0, against Martin and Moyce 1952, in
// percent: the rms of the relative difference at their times within the run, up to where they stand four widths out. The
// front is the foremost particle that has nineteen before it, so that spray does not count. front.csv holds the trace.

#include "Comparison.H"
#include "core/fieldFile/CsvFile.H"
#include "reference/DamBreak.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

class DamBreakComparison : public Comparison
{
public:
    explicit DamBreakComparison(const Dictionary& dict)
    : width_(dict.lookupPositive("width", dimensions::length)), within_(dict.lookupPositive("within", dimensions::none)) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        CsvFile trace
        (
            results.casePath()/"postProcessing/compareReference/front.csv", {{"time", ""}, {"front", ""}, {"measured", ""}}
        );
        const double none = std::nan("");
        std::vector<DamBreakFront> front;
        for (const TimeFolder& time : results.times())
        {
            front.push_back({time.value*std::sqrt(2*results.gravity/width_), position(results, time)/width_});
            trace.addRow({front.back().time, front.back().position, none});
        }

        double sum = 0, far = 0, farReference = 0;
        int count = 0;
        for (const DamBreakFront& measured : martinMoyce1952())
        {
            trace.addRow({measured.time, none, measured.position});
            if (measured.time > front.back().time || measured.position > 4.2) continue;
            const auto after = std::find_if
            (
                front.begin() + 1, front.end(), [&](const DamBreakFront& at) { return at.time >= measured.time; }
            );
            const auto before = after - 1;
            far = before->position
              + (after->position - before->position)*(measured.time - before->time)/(after->time - before->time);
            farReference = measured.position;
            sum += std::pow(far/measured.position - 1, 2);
            ++count;
        }
        trace.write();
        const double rms = count > 0 ? 100*std::sqrt(sum/count) : none;
        return
        {
            {"rms difference of the front", "%", 0, rms, rms, "%", within_},
            relativeRow("last front compared", "widths", farReference, count > 0 ? far : none, none)
        };
    }

private:
    static double position(const CaseResults& results, const TimeFolder& time)
    {
        constexpr std::size_t spray = 20;
        std::vector<double> x;
        for (const Vector3& each : results.positions(time)) x.push_back(each.x);
        const auto place = x.end() - std::min<long>(spray, long(x.size()));
        std::nth_element(x.begin(), place, x.end());
        return *place + 0.5*results.spacing;
    }

    double width_, within_;
};

static const ComparisonTable::Add<DamBreakComparison> registered{"damBreak"};

}
