// SPDX-License-Identifier: GPL-3.0-or-later
// type hydrostatic;  area 4e-4;  within 2;
// Liquid at rest in an upright tank of that section [m2], standing on z = 0, in percent of rho g H: the field p [Pa] of the
// latest time against rho g (H - z). p of a single particle carries what its neighbours' disorder makes of it, so the profile
// is judged: the mean of each slab one spacing thick, rms over the slabs deeper than two spacings; what single particles
// scatter about their slab's mean is a row of its own, without a target. nan where the pressure model writes no p. Also
// the level, twice the height of the centroid, against H = volume/area.

#include "Comparison.H"
#include "core/fieldFile/FieldFile.H"

#include <cmath>
#include <map>

namespace shizuku
{

class HydrostaticComparison : public JudgedComparison
{
public:
    explicit HydrostaticComparison(const Dictionary& dict)
    :
        JudgedComparison(dict), area_(dict.lookupPositive("area", Dimensions{{0, 2, 0, 0, 0, 0, 0}}))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const double level = results.liquidVolume()/area_, scale = results.rho*results.gravity;
        const TimeFolder& last = results.times().back();
        const std::vector<Vector3> positions = results.positions(last);

        double error = std::nan(""), scatter = error;
        if (std::filesystem::exists(last.path/"liquid/p"))
        {
            const FieldData p = readField(last.path/"liquid/p", FieldType::scalar, dimensions::pressure, long(positions.size()));
            std::map<long, Deviations> slabs;
            for (std::size_t i = 0; i < positions.size(); ++i)
            {
                const double depth = level - positions[i].z;
                if (depth < 2*results.spacing) continue;
                slabs[std::lround(std::floor(positions[i].z/results.spacing))].add(p(i)/(scale*level) - depth/level);
            }
            double ofSlabs = 0, ofParticles = 0, particles = 0;
            for (const auto& [number, slab] : slabs)
            {
                ofSlabs += slab.mean()*slab.mean()/double(slabs.size());
                ofParticles += slab.squares - slab.count*slab.mean()*slab.mean();
                particles += slab.count;
            }
            error = 100*std::sqrt(ofSlabs);
            scatter = 100*std::sqrt(ofParticles/particles);
        }

        // Twice the height of the centroid: the level, as the whole liquid tells it.
        double centroid = 0;
        for (const Vector3& x : positions) centroid += x.z/double(positions.size());
        return
        {
            {"rms error of the pressure's profile", "%", 0, error, error, "%", within_},
            {"scatter of the particles' pressure", "%", 0, scatter, scatter, "%", std::nan("")},
            relativeRow("level", "m", level, 2*centroid, within_)
        };
    }

private:
    struct Deviations
    {
        double count = 0, sum = 0, squares = 0;

        void add(double deviation)
        {
            count += 1;
            sum += deviation;
            squares += deviation*deviation;
        }

        double mean() const { return sum/count; }
    };

    double area_;
};

static const ComparisonTable::Add<HydrostaticComparison> registered{"hydrostatic"};

}
