// SPDX-License-Identifier: GPL-3.0-or-later
// How much of some planes the liquid covers, over time.
//
//     foot
//     {
//         type        crossSection;
//         normal      (0 0 1);
//         places      (0.5e-4 1.5e-4);        // m: of the planes, along the normal from the origin
//         thickness   1e-4;                   // m, default: a spacing
//     }
//
// A row a plane, of the particles whose centres are within half the thickness of it: their volume over the thickness, which is an average over that of the area of
// the liquid's own section where particles lie as densely as anywhere; and the radius of the disc that has their second moment about their centroid,
// each a square of a spacing. Along walls particles lie in layers, which need not be a spacing thick: of a round section the radius is the one to
// trust there. Of planes half a spacing and one and a half above a wall 1.5 r_0 - 0.5 r_1 is that on the wall.

#include "caseFiles/UnitVector.H"
#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"
#include "maths/WholeSum.H"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace shizuku
{

namespace
{

// Of places in spans of 1,024 spacings, so that small liquid and wide liquid are held as well as any. The same in any order, and so in any parts.
struct Sums
{
    static constexpr double span = 1024;    // spacings

    std::int64_t count = 0;
    WideSum places[3], squares;

    void add(const Vector3& x)
    {
        ++count;
        for (int c = 0; c < 3; ++c) places[c] += wideQuanta(x[c]);
        squares += wideQuanta(dot(x, x));
    }

    void add(const Sums& other)
    {
        count += other.count;
        for (int c = 0; c < 3; ++c) places[c] += other.places[c];
        squares += other.squares;
    }

    // m. Of a disc <r^2> is half the radius squared; of a square of side d a sixth of d^2.
    double radius(double d) const
    {
        if (count == 0) return 0;
        const Vector3 mean = 1/double(count)*Vector3(valueOf(places[0]), valueOf(places[1]), valueOf(places[2]));
        return d*std::sqrt(2*(span*span*std::max(0.0, valueOf(squares)/double(count) - dot(mean, mean)) + 1.0/6));
    }
};

class CrossSection : public FunctionObject
{
public:
    CrossSection(const Dictionary& dict, const FunctionSetting& setting)
    :
        normal_(readUnitVector(dict, "normal")), places_(dict.lookup<std::vector<double>>("places")),
        spacing_(setting.spacing), thickness_(dict.found("thickness") ? dict.lookupPositive("thickness", dimensions::length) : setting.spacing),
        table_(setting.folder / "crossSection.csv", {{"time", "s"}, {"place", "m"}, {"area", "m2"}, {"radius", "m"}})
    {
        if (places_.empty()) throw FatalInputError(dict.where("places"), "There is no plane", "one place at least");
    }

    void execute(FlowView& flow) override
    {
        std::vector<Sums> within(places_.size());
        for (const Vector3& x : flow.positionsOfPart())
        {
            const double along = dot(x, normal_);
            for (std::size_t i = 0; i < places_.size(); ++i)
            {
                if (along >= places_[i] - 0.5*thickness_ && along < places_[i] + 0.5*thickness_) within[i].add(1/(Sums::span*spacing_)*(x - along*normal_));
            }
        }
        for (Sums& sums : within) sums = flow.parts().fold(sums);
        if (flow.parts().part() > 0) return;
        for (std::size_t i = 0; i < places_.size(); ++i)
        {
            const double area = double(within[i].count) * flow.properties().particleVolume() / thickness_;
            table_.addRow({flow.time.value(), places_[i], area, within[i].radius(spacing_)});
        }
    }

    bool measuresInParts() const override { return true; }
    bool looksAtDensities() const override { return false; }
    const CsvFile* table() const override { return &table_; }

private:
    Vector3 normal_;
    std::vector<double> places_;        // m
    double spacing_, thickness_;        // m
    CsvFile table_;
};

const FunctionObjectTable::Add<CrossSection> registered{"crossSection", "how much of some planes the liquid covers"};

}

}
