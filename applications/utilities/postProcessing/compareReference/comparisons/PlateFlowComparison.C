// SPDX-License-Identifier: GPL-3.0-or-later
// type plateFlow;  moving plate;  fixed table;  middle 0.5;  within 2;
// Liquid between two parallel plane walls, of which one has a motion of type translation along itself from time 0 on: velocities over the height against the exact profile, at each written time
// behind the start. Of layers a spacing thick, of what is nearer than `middle` gaps to the liquid's axis: rms of their means off the exact ones, in percent of the wall's speed.

#include "Comparison.H"
#include "caseFiles/VectorField.H"
#include "reference/PlateFlow.H"
#include "wallMotions/WallMotions.H"

#include <cmath>
#include <map>
#include <sstream>

namespace shizuku
{

class PlateFlowComparison : public Comparison
{
public:
    explicit PlateFlowComparison(const Dictionary& dict)
    :
        moving_(dict.lookup<std::string>("moving")), fixed_(dict.lookup<std::string>("fixed")), movingAt_(dict.where("moving")), fixedAt_(dict.where("fixed")),
        middle_(dict.lookupPositive("middle", dimensions::none)), within_(dict.lookupPositive("within", dimensions::none))
    {}

    std::vector<ComparisonRow> compare(const CaseResults& results) const override
    {
        const CaseWalls walls = readCaseWalls(results.casePath());
        const auto plane = [&](const std::string& name, const SourceLocation& where)
        {
            const auto found = planeOf(walls, name, results.spacing);
            if (!found) throw FatalInputError(where, "The wall '" + name + "' is no plane", "a plane wall of constant/walls", walls.names, name);
            return *found;
        };
        const Plane plate = plane(moving_, movingAt_), other = plane(fixed_, fixedAt_);
        const WallMotions motions = WallMotions::read(results.casePath());
        const int index = motions.indexOf(moving_);
        if (index < 0) throw FatalInputError(movingAt_, "The wall '" + moving_ + "' does not move", "one with a motion in constant/walls");
        const double gap = plate.distance(other.point);

        std::vector<ComparisonRow> rows;
        for (const TimeFolder& time : results.times())
        {
            if (!(time.value > 0)) continue;
            const Vector3 velocity = motions.walls()[index].motion->at(time.value).shift/time.value;
            rows.push_back(profileRow(results, time, plate, gap, velocity));
        }
        return rows;
    }

private:
    struct Layer
    {
        double height = 0, speed = 0;
        int particles = 0;
    };

    ComparisonRow profileRow(const CaseResults& results, const TimeFolder& time, const Plane& plate, double gap, const Vector3& velocity) const
    {
        const std::vector<Vector3> x = results.positions(time);
        const std::vector<Vector3> u = toVectors(readField(time.path/"liquid/U", FieldType::vector, dimensions::velocity, long(x.size())), x.size());
        Vector3 centre;
        for (const Vector3& p : x) centre += p/double(x.size());
        std::map<int, Layer> layers;
        for (std::size_t i = 0; i < x.size(); ++i)
        {
            const Vector3 r = x[i] - centre, across = r - dot(r, plate.normal)*plate.normal;
            if (length(across) > middle_*gap) continue;
            const double height = plate.distance(x[i]);
            Layer& layer = layers[int(std::floor(height/results.spacing))];
            layer.height += height;
            layer.speed += dot(u[i], velocity)/squaredLength(velocity);
            ++layer.particles;
        }
        const double diffused = results.nu*time.value/(gap*gap);
        double squares = 0, all = 0;
        for (const auto& [number, layer] : layers)
        {
            const double off = layer.speed/layer.particles - plateFlow(layer.height/layer.particles/gap, diffused);
            squares += layer.particles*off*off;
            all += layer.particles;
        }
        std::ostringstream quantity;
        quantity << "profile after " << std::round(1e3*diffused)/1e3 << " H2/nu";
        const double rms = 100*std::sqrt(squares/all);
        return {quantity.str(), "", 0, rms, rms, "%", within_};
    }

    std::string moving_, fixed_;
    SourceLocation movingAt_, fixedAt_;
    double middle_, within_;        // gaps, percent
};

static const ComparisonTable::Add<PlateFlowComparison> registered{"plateFlow"};

}
