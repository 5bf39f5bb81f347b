// SPDX-License-Identifier: GPL-3.0-or-later
// How many drops there are, and how large they are.
//
//     sizes { type drops; classes (1e-3 2e-3 3e-3); }
//
// Separate bodies of liquid (drops/SeparateBodies.H; across cyclic sides too) of twenty particles and more are drops, wherever they are; others are spray. Diameters are those of spheres of
// their volumes, d^3 a particle: the mean of them; the one that half of the volume is in drops below; and the largest. classes [m]: between
// these diameters drops are counted, in columns of their own. What has left the largest body, and particles that are alone, are counted too; the log tells them.

#include "core/fieldFile/CsvFile.H"
#include "drops/BodySizes.H"
#include "drops/SeparateBodies.H"
#include "functionObjects/FunctionObject.H"

#include <algorithm>
#include <functional>
#include <sstream>

namespace shizuku
{

namespace
{

constexpr int leastParticles = 20;              // of a drop, as probeAngle has it

class DropCount : public FunctionObject
{
public:
    DropCount(const Dictionary& dict, const FunctionSetting& setting)
    :
        classes_(dict.lookupOr("classes", std::vector<double>())), table_(setting.folder / "drops.csv", columns(classes_))
    {
        const bool ascending = std::adjacent_find(classes_.begin(), classes_.end(), std::greater_equal<double>()) == classes_.end();
        if (ascending && (classes_.empty() || classes_.front() >= 0)) return;
        throw FatalInputError(dict.where("classes"), "The classes are not in ascending order", "diameters in metres, each above the one before");
    }

    void execute(FlowView& flow) override
    {
        const std::vector<int> sizes = bodySizes(flow.positionsOfPart(), flow.properties().spacing, flow.parts(), flow.sides());
        if (flow.parts().part() > 0) return;
        std::vector<double> diameters, volumes;             // the largest first
        double all = 0, sum = 0, spray = 0, sprayParticles = 0, alone = 0;
        for (const int particles : sizes)
        {
            const double volume = particles*flow.properties().particleVolume();
            if (particles < leastParticles)
            {
                spray += volume;
                sprayParticles += particles;
                if (particles == 1) ++alone;
                continue;
            }
            diameters.push_back(diameterOf(volume));
            volumes.push_back(volume);
            all += volumes.back();
            sum += diameters.back();
        }
        const double number = double(diameters.size()), off = flow.particles() - (sizes.empty() ? 0.0 : double(sizes.front()));
        std::vector<CsvFile::Cell> row
        {
            flow.time.value(), number, number > 0 ? sum / number : 0.0, halfVolume(diameters, volumes, all), number > 0 ? diameters.front() : 0.0, spray,
            off, alone
        };
        for (std::size_t k = 0; k + 1 < classes_.size(); ++k)
        {
            const auto isIn = [&](double diameter) { return diameter >= classes_[k] && diameter < classes_[k + 1]; };
            row.emplace_back(double(std::count_if(diameters.begin(), diameters.end(), isIn)));
        }
        table_.addRow(row);
        std::ostringstream text;
        text << "drops " << number << ", particles off the largest body " << off << ", in bodies below " << leastParticles << ' ' << sprayParticles
             << ", alone " << alone;
        report_ = text.str();
    }

    bool measuresInParts() const override { return true; }
    bool looksAtDensities() const override { return false; }
    const CsvFile* table() const override { return &table_; }
    std::string report() const override { return report_; }

private:
    static double halfVolume(const std::vector<double>& diameters, const std::vector<double>& volumes, double all)
    {
        double above = 0;
        for (std::size_t k = 0; k < volumes.size(); ++k)
        {
            above += volumes[k];
            if (above >= 0.5 * all) return diameters[k];
        }
        return 0;
    }

    static std::vector<CsvFile::Column> columns(const std::vector<double>& classes)
    {
        std::vector<CsvFile::Column> columns
        {
            {"time", "s"}, {"drops", ""}, {"meanDiameter", "m"}, {"medianDiameter", "m"}, {"largestDiameter", "m"}, {"spray", "m3"},
            {"offLargest", ""}, {"alone", ""}
        };
        for (std::size_t k = 0; k + 1 < classes.size(); ++k)
        {
            std::ostringstream name;
            name << "from" << classes[k] << "to" << classes[k + 1];
            columns.push_back({name.str(), ""});
        }
        return columns;
    }

    std::vector<double> classes_;           // m, ascending
    CsvFile table_;
    std::string report_;
};

const FunctionObjectTable::Add<DropCount> registered{"drops", "how many drops there are, and their sizes"};

}

}
