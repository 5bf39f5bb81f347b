// SPDX-License-Identifier: GPL-3.0-or-later
// The box around the liquid over time: least and largest coordinates of its particles' centres, half a spacing inside of what they fill.
//
//     extent { type boundingBox; }

#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"
#include "meshes/Bounds.H"

namespace shizuku
{

namespace
{

class BoundingBox : public FunctionObject
{
public:
    BoundingBox(const Dictionary&, const FunctionSetting& setting)
    :
        table_
        (
            setting.folder / "boundingBox.csv",
            {
                {"time", "s"}, {"minX", "m"}, {"minY", "m"}, {"minZ", "m"}, {"maxX", "m"}, {"maxY", "m"}, {"maxZ", "m"}
            }
        )
    {}

    void execute(FlowView& flow) override
    {
        const Bounds box = flow.parts().fold(boundsOf(flow.positionsOfPart()));
        if (flow.parts().part() > 0) return;
        table_.addRow({flow.time.value(), box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z});
    }

    bool measuresInParts() const override { return true; }
    bool looksAtDensities() const override { return false; }
    const CsvFile* table() const override { return &table_; }

private:
    CsvFile table_;
};

const FunctionObjectTable::Add<BoundingBox> registered{"boundingBox", "least and largest coordinates of the liquid"};

}

}
