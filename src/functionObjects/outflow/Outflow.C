// SPDX-License-Identifier: GPL-3.0-or-later
// What is there and what was taken out (constant/outlets), over time.
//
//     out { type outflow; }
//
// particles and volume: of what is there, d^3 a particle; takenOut, takenOutVolume: of what all outlets took out since the case's first time; then the
// volume of each outlet, by its name. What is there and what was taken out are together what there was, to the particle.

#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"
#include "outlets/Outlets.H"

namespace shizuku
{

namespace
{

class Outflow : public FunctionObject
{
public:
    Outflow(const Dictionary& dict, const FunctionSetting& setting)
    :
        outlets_(Outlets::names(setting.casePath)), table_(setting.folder / "outflow.csv", columns(outlets_))
    {
        if (outlets_.empty()) throw FatalInputError(dict.where(), "The case has no outlet", "one in constant/outlets");
    }

    void execute(FlowView& flow) override
    {
        const double each = flow.properties().particleVolume();
        std::vector<double> taken;
        double all = 0;
        for (const std::string& outlet : outlets_)
        {
            taken.push_back(flow.numbers().at(Outlets::numberOf(outlet)));
            all += taken.back();
        }
        std::vector<CsvFile::Cell> row{flow.time.value(), double(flow.particles()), flow.particles() * each, all, all * each};
        for (const double number : taken) row.emplace_back(number * each);
        table_.addRow(row);
    }

    bool looksAtDensities() const override { return false; }
    bool looksAtParticles() const override { return false; }
    const CsvFile* table() const override { return &table_; }

private:
    static std::vector<CsvFile::Column> columns(const std::vector<std::string>& outlets)
    {
        std::vector<CsvFile::Column> columns{{"time", "s"}, {"particles", ""}, {"volume", "m3"}, {"takenOut", ""}, {"takenOutVolume", "m3"}};
        for (const std::string& outlet : outlets) columns.push_back({outlet, "m3"});
        return columns;
    }

    std::vector<std::string> outlets_;
    CsvFile table_;
};

const FunctionObjectTable::Add<Outflow> registered{"outflow", "what outlets have taken out"};

}

}
