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
// A row a plane: its place and area, the volume of the particles whose centres are within half the thickness of it, over the thickness: an
// average over that of the liquid's own section. Of planes half a spacing and one and a half above a wall 1.5 A_0 - 0.5 A_1 is the
// area on the wall, where the liquid is as thick.

#include "caseFiles/UnitVector.H"
#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"

#include <vector>

namespace shizuku
{

namespace
{

class CrossSection : public FunctionObject
{
public:
    CrossSection(const Dictionary& dict, const FunctionSetting& setting)
    :
        normal_(readUnitVector(dict, "normal")), places_(dict.lookup<std::vector<double>>("places")),
        thickness_(dict.found("thickness") ? dict.lookupPositive("thickness", dimensions::length) : setting.spacing),
        table_(setting.folder / "crossSection.csv", {{"time", "s"}, {"place", "m"}, {"area", "m2"}})
    {
        if (places_.empty()) throw FatalInputError(dict.where("places"), "There is no plane", "one place at least");
    }

    void execute(FlowView& flow) override
    {
        std::vector<long> within(places_.size(), 0);
        for (const Vector3& x : flow.positions())
        {
            const double along = dot(x, normal_);
            for (std::size_t i = 0; i < places_.size(); ++i)
            {
                within[i] += along >= places_[i] - 0.5*thickness_ && along < places_[i] + 0.5*thickness_;
            }
        }
        for (std::size_t i = 0; i < places_.size(); ++i)
        {
            table_.addRow({flow.time.value(), places_[i], double(within[i]) * flow.properties().particleVolume() / thickness_});
        }
    }

    bool looksAtDensities() const override { return false; }
    const CsvFile* table() const override { return &table_; }

private:
    Vector3 normal_;
    std::vector<double> places_;        // m
    double thickness_;                  // m
    CsvFile table_;
};

const FunctionObjectTable::Add<CrossSection> registered{"crossSection", "how much of some planes the liquid covers"};

}

}
