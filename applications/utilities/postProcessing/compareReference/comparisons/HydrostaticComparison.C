// type hydrostatic;  area 4e-4;  within 2;
// Liquid at rest in an upright tank of that section [m2], standing on z = 0, in percent of rho g H: the field p [Pa] of the
// latest time against rho g (H - z), rms over the particles deeper than two spacings; nan where the
// pressure model writes no p. Also the level, twice the height of the centroid, against H = volume/area.

#include "Comparison.H"
#include "core/fieldFile/FieldFile.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

class HydrostaticComparison : public Comparison
{
public:
    explicit HydrostaticComparison(const Dictionary& dict)
    :
        area_(dict.lookupPositive("area", Dimensions{{0, 2, 0, 0, 0, 0, 0}})),
        within_(dict.lookupPositive("within", dimensions::none))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const double level = results.liquidVolume()/area_, scale = results.rho*results.gravity;
        const TimeFolder& last = results.times().back();
        const std::vector<Vector3> positions = results.positions(last);

        double error = std::nan("");
        if (std::filesystem::exists(last.path/"liquid/p"))
        {
            const FieldData p = readField(last.path/"liquid/p", FieldType::scalar, dimensions::pressure, long(positions.size()));
            double sum = 0;
            long count = 0;
            for (std::size_t i = 0; i < positions.size(); ++i)
            {
                const double depth = level - positions[i].z;
                if (depth < 2*results.spacing) continue;
                sum += std::pow(p(i) - scale*depth, 2);
                ++count;
            }
            error = 100*std::sqrt(sum/double(count))/(scale*level);
        }

        // Twice the height of the centroid: the level, as the whole liquid tells it.
        double centroid = 0;
        for (const Vector3& x : positions) centroid += x.z/double(positions.size());
        return
        {
            {"rms error of the pressure", "%", 0, error, error, "%", within_},
            relativeRow("level", "m", level, 2*centroid, within_)
        };
    }

private:
    double area_, within_;
};

static const ComparisonTable::Add<HydrostaticComparison> registered{"hydrostatic"};

}
