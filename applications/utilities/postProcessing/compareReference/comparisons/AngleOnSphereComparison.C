// type angleOnSphere;  theta 60;  within 3;
// The angles at which the largest drop meets a curved solid without gravity, as probeAngle measured them at the latest time,
// against theta [degrees]: that of its cap, and for information the mean along the contact line. nan where the two do not
// meet.

#include "Comparison.H"

#include <limits>

namespace shizuku
{

class AngleOnSphereComparison : public Comparison
{
public:
    explicit AngleOnSphereComparison(const Dictionary& dict)
    : theta_(dict.lookup<double>("theta")), within_(dict.lookupPositive("within", dimensions::none)) {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        constexpr double none = std::numeric_limits<double>::quiet_NaN();
        const CsvTable drops = results.table("probeAngle", "angle.csv");
        if (drops.rows() == 0) throw FatalInputError({results.casePath().string(), 0}, "probeAngle found no drop");
        std::size_t largest = drops.rows() - 1;
        for (std::size_t row = largest; row-- > 0 && drops.text(row, "time") == drops.text(largest, "time");)
        {
            if (drops.number(row, "volume") > drops.number(largest, "volume")) largest = row;
        }
        return
        {
            absoluteRow("contact angle", "deg", theta_, drops.number(largest, "angle"), within_),
            absoluteRow("angle along the contact line", "deg", theta_, drops.number(largest, "tangentMean"), none)
        };
    }

private:
    double theta_, within_;
};

static const ComparisonTable::Add<AngleOnSphereComparison> registered{"angleOnSphere"};

}
