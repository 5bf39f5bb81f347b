// The liquid's volume over time, three ways.
//
//     size { type volume; }               // crowded no: without that column, for which densities are computed
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
    Volume(const Dictionary& dict, const FunctionSetting& setting)
    :
        crowded_(dict.lookupOr("crowded", true)),
        table_(setting.folder / "volume.csv", columns(crowded_))
    {
        setting.requireSurface();
    }

    void execute(FlowView& flow) override
    {
        const double enclosed = flow.surfaceVolume();
        const double particles = flow.particles() * flow.properties().particleVolume();
        std::vector<CsvFile::Cell> row{flow.time.value(), enclosed, particles, 100 * (enclosed / particles - 1)};
        if (crowded_) row.insert(row.end() - 1, flow.state().volume);
        table_.addRow(row);
    }

    const CsvFile* table() const override { return &table_; }

private:
    static std::vector<CsvFile::Column> columns(bool crowded)
    {
        std::vector<CsvFile::Column> columns{{"time", "s"}, {"volume", "m3"}, {"particleVolume", "m3"}, {"drift", "%"}};
        if (crowded) columns.insert(columns.end() - 1, CsvFile::Column{"crowded", "m3"});
        return columns;
    }

    bool crowded_;
    CsvFile table_;
};

const FunctionObjectTable::Add<Volume> registered{"volume"};

}

}
