// SPDX-License-Identifier: GPL-3.0-or-later
// How far the liquid has spread on each wall.
//
//     spread
//     {
//         type    spreadDiameter;
//         wall    floor;              // default: every wall; a box is six
//     }
//
// A row a wall: its normal, averaged over what is wetted; wettedArea; wettedDiameter, of the disc of that area;
// wettedExtent, the largest distance between wetted places; liquidExtent, that of the whole liquid along the wall; and height,
// of the liquid's highest place above the wetted ones. Not a number where the wall is dry.

#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"

namespace shizuku
{

namespace
{

class SpreadDiameter : public FunctionObject
{
public:
    SpreadDiameter(const Dictionary& dict, const FunctionSetting& setting)
    :
        walls_(WettedSurface::wallsOf(setting.casePath)),
        table_
        (
            setting.folder / "spreadDiameter.csv",
            {
                {"time", "s"}, {"wall", ""}, {"normalX", ""}, {"normalY", ""}, {"normalZ", ""}, {"wettedArea", "m2"},
                {"wettedDiameter", "m"}, {"wettedExtent", "m"}, {"liquidExtent", "m"}, {"height", "m"}
            }
        )
    {
        setting.requireSurface();
        if (walls_.empty()) throw FatalInputError(dict.where(), "The case has no wall to spread on", "a wall in constant/walls");
        if (dict.found("wall")) wall_ = dict.lookupChoice("wall", walls_);
    }

    void modelsMade(FlowView& flow) override { flow.prepareContacts(); }

    void execute(FlowView& flow) override
    {
        for (int wall = 0; wall < int(walls_.size()); ++wall)
        {
            if (!wall_.empty() && walls_[wall] != wall_) continue;
            const Spread spread = measureSpread(flow.surfacePiece(), flow.contacts(), wall, flow.parts());
            if (flow.parts().part() > 0) continue;
            const Vector3& n = spread.normal;
            table_.addRow
            ({
                flow.time.value(), walls_[wall], n.x, n.y, n.z, spread.wettedArea, spread.wettedDiameter,
                spread.wettedExtent, spread.liquidExtent, spread.height
            });
        }
    }

    bool measuresInParts() const override { return true; }
    bool looksAtDensities() const override { return false; }
    bool looksAtSurface() const override { return true; }
    const CsvFile* table() const override { return &table_; }

private:
    std::vector<std::string> walls_;
    std::string wall_;                  // empty: all
    CsvFile table_;
};

const FunctionObjectTable::Add<SpreadDiameter> registered{"spreadDiameter", "how far the liquid has spread on each wall"};

}

}
