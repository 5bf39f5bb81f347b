// SPDX-License-Identifier: GPL-3.0-or-later
// Contact angles, contact radius, height and volume of every drop on a wall while the solver runs: what meshSurface
// and probeAngle would find of the same time, in the same columns (drops/DropTable.H).
//
//     angle
//     {
//         type        contactAngle;
//         wall        floor;          // this, fitAbove and direction as in system/probeAngleDict
//     }

#include "drops/DropMeasurement.H"
#include "functionObjects/FunctionObject.H"
#include "parallel/AllParts.H"

namespace shizuku
{

namespace
{

DropMeasurement measurementOf(const Dictionary& dict, const FunctionSetting& setting)
{
    const CaseWalls walls = readCaseWalls(setting.casePath);
    return DropMeasurement(setting.casePath, DropControls::read(dict, walls), walls, setting.spacing);
}

class ContactAngleTable : public FunctionObject
{
public:
    ContactAngleTable(const Dictionary& dict, const FunctionSetting& setting)
    :
        measurement_(measurementOf(dict, setting)), table_(dropTable(setting.folder / "contactAngle.csv"))
    {
        setting.requireSurface();
    }

    // A changed angle counts once the models have it.
    void modelsMade(FlowView& flow) override
    {
        const auto& angles = flow.walls.angles();
        measurement_.readCase(flow.time.value(), angles ? angles->particles : std::vector<double>());
    }

    void execute(FlowView& flow) override
    {
        std::vector<Drop> drops;
        if (flow.parts().part() == 0) drops = measurement_.dropsOf(flow.surface());
        const std::vector<long> particles = particlesInside(drops, flow.positionsOfPart(), flow.parts());
        std::vector<DropRecord> records = measurement_.measure(drops, particles, flow.time.value(), heldAngles(flow));
        if (flow.parts().part() > 0) return;
        measurement_.number(records);
        for (const DropRecord& record : records) addRow(table_, record);
    }

    // Drops keep their numbers and first volumes.
    KeptNumbers state(double) const override { return measurement_.state(); }
    void goOn(const KeptNumbers& state, double) override { measurement_.goOn(state); }

    bool measuresInParts() const override { return true; }
    bool looksAtDensities() const override { return false; }
    bool looksAtSurface() const override { return true; }
    bool looksAtWholeSurface() const override { return true; }
    const CsvFile* table() const override { return &table_; }

private:
    // Of all parts, in part 0.
    HeldAngles heldAngles(FlowView& flow) const
    {
        HeldAngles held;
        if (!flow.models.heldLine || !measurement_.hasLaw()) return held;
        const std::vector<scalar> angles = flow.models.heldLine->angle().download();
        const HeldAngles own = HeldAngles::of(flow.positionsOfPart(), {angles.begin(), angles.end()});
        return {gatherListsAtFirst(flow.parts(), own.positions), gatherListsAtFirst(flow.parts(), own.angles)};
    }

    DropMeasurement measurement_;
    CsvFile table_;
};

const FunctionObjectTable::Add<ContactAngleTable> registered{"contactAngle", "contact angles, radius, height and volume of every drop on a wall"};

}

}
