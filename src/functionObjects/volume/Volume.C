// The liquid's volume over time, three ways.
//
//     size { type volume; }
//
// volume: what the surface mesh encloses; particleVolume: d^3 times the number of particles, which never changes;
// crowded: sum of d^3/max(rho_i/rho0, 1), which falls where particles crowd; drift: volume against particleVolume.

#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"

namespace shizuku
{

namespace
{

class Volume : public FunctionObject
{
public:
    Volume(const Dictionary&, const FunctionSetting& setting)
    :
        table_
        (
            setting.folder / "volume.csv",
            {{"time", "s"}, {"volume", "m3"}, {"particleVolume", "m3"}, {"crowded", "m3"}, {"drift", "%"}}
        )
    {
        setting.requireSurface();
    }

    void execute(FlowView& flow) override
    {
        const double enclosed = flow.surfaceVolume();
        const double particles = flow.liquid().owned() * flow.properties().particleVolume();
        table_.addRow
        ({
            flow.time.value(), enclosed, particles, flow.state().volume, 100 * (enclosed / particles - 1)
        });
    }

    WriteJob writing() override { return table_.writing(); }

private:
    CsvFile table_;
};

const FunctionObjectTable::Add<Volume> registered{"volume"};

}

}
