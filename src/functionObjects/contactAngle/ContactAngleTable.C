// Contact angle, contact radius, height and volume of every drop on a plane wall while the solver runs: what meshSurface
// and probeAngle would find of the same time, in the same columns (geometry/drops/DropTable.H).
//
//     angle
//     {
//         type        contactAngle;
//         wall        floor;          // this and fitAbove as in system/probeAngleDict
//     }

#include "functionObjects/FunctionObject.H"
#include "geometry/drops/DropMeasurement.H"

namespace shizuku
{

namespace
{

DropMeasurement measurementOf(const Dictionary& dict, const FlowView& flow)
{
    const std::filesystem::path& casePath = flow.time.casePath();
    const CaseWalls walls = readCaseWalls(casePath);
    return DropMeasurement(casePath, DropControls::read(dict, walls), walls, flow.properties().spacing);
}

class ContactAngleTable : public FunctionObject
{
public:
    ContactAngleTable(const Dictionary& dict, FlowView& flow, const std::filesystem::path& folder)
    :
        measurement_(measurementOf(dict, flow)), table_(dropTable(folder / "contactAngle.csv"))
    {
        flow.requireSurface();
    }

    void execute(FlowView& flow) override
    {
        for (const DropRecord& drop : measurement_.measure(flow.surface(), flow.positions(), flow.time.value()))
        {
            addRow(table_, drop);
        }
    }

    void write() override { table_.write(); }

private:
    DropMeasurement measurement_;
    CsvFile table_;
};

const FunctionObjectTable::Add<ContactAngleTable> registered{"contactAngle"};

}

}
