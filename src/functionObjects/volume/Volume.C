// SPDX-License-Identifier: GPL-3.0-or-later
// The liquid's volume over time.
//
//     size { type volume; }
//
//     crowded     yes;        // that column, for which densities are computed
//     spray       no;
//
// volume: what the surface mesh encloses; spray: d^3 times the number of particles that it does not, lone
// ones; particleVolume: d^3 times the number of all, which outlets alone change; crowded: sum of d^3/max(rho_i/rho0, 1), which
// falls where particles crowd; drift: volume against particleVolume.

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
        spray_(dict.lookupOr("spray", false)),
        crowded_(dict.lookupOr("crowded", true)),
        table_(setting.folder / "volume.csv", columns(spray_, crowded_))
    {
        setting.requireSurface();
    }

    void execute(FlowView& flow) override
    {
        const double enclosed = flow.surfaceVolume();
        const double particle = flow.properties().particleVolume(), particles = flow.particles() * particle;
        std::vector<CsvFile::Cell> row{flow.time.value(), enclosed};
        if (spray_) row.emplace_back(flow.particlesOutsideSurface() * particle);
        row.emplace_back(particles);
        if (crowded_) row.emplace_back(flow.state().volume);
        row.emplace_back(100 * (enclosed / particles - 1));
        table_.addRow(row);
    }

    bool looksAtDensities() const override { return crowded_; }
    bool looksAtParticles() const override { return false; }
    bool looksAtSurface() const override { return true; }
    const CsvFile* table() const override { return &table_; }

private:
    static std::vector<CsvFile::Column> columns(bool spray, bool crowded)
    {
        std::vector<CsvFile::Column> columns{{"time", "s"}, {"volume", "m3"}};
        if (spray) columns.push_back({"spray", "m3"});
        columns.push_back({"particleVolume", "m3"});
        if (crowded) columns.push_back({"crowded", "m3"});
        columns.push_back({"drift", "%"});
        return columns;
    }

    bool spray_, crowded_;
    CsvFile table_;
};

const FunctionObjectTable::Add<Volume> registered{"volume", "the liquid's volume"};

}

}
