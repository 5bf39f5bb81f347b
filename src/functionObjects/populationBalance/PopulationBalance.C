// SPDX-License-Identifier: GPL-3.0-or-later
// What came, what went and what is there, over time (constant/sources, constant/outlets).
//
//     balance { type populationBalance; }
//
// filled + entered - left = particles, exactly; the volumes are d^3 times these. Then the volume that each source has let in, less what it drew, and that each
// outlet has taken out, by their names.

#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"
#include "population/Population.H"

namespace shizuku
{

namespace
{

class PopulationBalance : public FunctionObject
{
public:
    PopulationBalance(const Dictionary& dict, const FunctionSetting& setting)
    :
        sources_(Sources::names(setting.casePath)), outlets_(Outlets::names(setting.casePath)), table_(setting.folder / "populationBalance.csv", columns())
    {
        if (sources_.empty()) throw FatalInputError(dict.where(), "The case has no source", "one in constant/sources; or the type outflow, where outlets alone are");
    }

    void execute(FlowView& flow) override
    {
        const double each = flow.properties().particleVolume();
        const auto& numbers = flow.numbers();
        double entered = 0, left = 0;
        std::vector<double> volumes;
        for (const std::string& name : sources_)
        {
            const double number = numbers.at(Sources::numberOf(name));
            entered += number;
            volumes.push_back(number * each);
        }
        for (const std::string& name : outlets_)
        {
            const double number = numbers.at(Outlets::numberOf(name));
            left += number;
            volumes.push_back(number * each);
        }
        std::vector<CsvFile::Cell> row{flow.time.value(), numbers.at(Population::filledNumber), entered, left, double(flow.particles()), flow.particles() * each};
        row.insert(row.end(), volumes.begin(), volumes.end());
        table_.addRow(row);
    }

    bool looksAtDensities() const override { return false; }
    bool looksAtParticles() const override { return false; }
    const CsvFile* table() const override { return &table_; }

private:
    std::vector<CsvFile::Column> columns() const
    {
        std::vector<CsvFile::Column> columns{{"time", "s"}, {"filled", ""}, {"entered", ""}, {"left", ""}, {"particles", ""}, {"volume", "m3"}};
        for (const auto* names : {&sources_, &outlets_})
        {
            for (const std::string& name : *names) columns.push_back({name, "m3"});
        }
        return columns;
    }

    std::vector<std::string> sources_, outlets_;
    CsvFile table_;
};

const FunctionObjectTable::Add<PopulationBalance> registered{"populationBalance", "what sources let in, outlets took out, and what is there"};

}

}
