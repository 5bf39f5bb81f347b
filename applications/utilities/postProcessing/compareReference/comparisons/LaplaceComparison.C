// SPDX-License-Identifier: GPL-3.0-or-later
// type laplace;  within 2;
// The pressure inside of a free drop against Laplace's jump 2 sigma/R, in percent: the mean of the field p [Pa] over the
// particles within 0.6 R of the drop's centre, over the written times of the second half of the run. Not measured (nan)
// where the pressure model writes no p.

#include "Comparison.H"
#include "core/fieldFile/FieldFile.H"

#include <cmath>

namespace shizuku
{

static std::vector<ComparisonRow> compareLaplace(const CaseResults& results, double within)
{
    double sum = 0;
    long count = 0;
    for (const TimeFolder& time : results.times())
    {
        const std::filesystem::path file = time.path/"liquid/p";
        if (time.value < 0.5*results.times().back().value || !std::filesystem::exists(file)) continue;
        const std::vector<Vector3> positions = results.positions(time);
        const FieldData p = readField(file, FieldType::scalar, dimensions::pressure, long(positions.size()));
        const Vector3 centre = meanOf(positions);
        for (std::size_t i = 0; i < positions.size(); ++i)
        {
            if (length(positions[i] - centre) > 0.6*results.radius()) continue;
            sum += p(i);
            ++count;
        }
    }
    const double measured = count > 0 ? sum/double(count) : std::nan("");
    return {relativeRow("pressure jump", "Pa", 2*results.sigma/results.radius(), measured, within)};
}

static const ComparisonTable::Add<PlainComparison<compareLaplace>> registered{"laplace"};

}
