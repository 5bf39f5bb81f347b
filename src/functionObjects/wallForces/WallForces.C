// SPDX-License-Identifier: GPL-3.0-or-later
// Force and moment of the liquid on each wall of constant/walls, over time.
//
//     forces { type wallForces; CofR (0 0 0); }
//
// Of each wall the forces by pressure, contact line and friction, N, and their moments about CofR, N m: means over the time since the last row. All walls' together
// are what the liquid lost of momentum beyond gravity's, to rounding (models/reactions/WallReactions.H has how walls share it).

#include "functionObjects/FunctionObject.H"
#include "models/reactions/WallReactions.H"

#include <cmath>
#include <sstream>

namespace shizuku
{

namespace
{

class WallForces : public FunctionObject
{
public:
    WallForces(const Dictionary& dict, const FunctionSetting& setting)
    :
        centre_(dict.lookupOr("CofR", std::array<double, 3>{})), walls_(WallEntries::readNames(setting.casePath)), table_(setting.folder / "wallForces.csv", columns(walls_))
    {
        if (walls_.empty()) throw FatalInputError(dict.where(), "The case has no wall", "one in constant/walls");
    }

    // The first row counts from here.
    void modelsMade(FlowView& flow) override
    {
        if (!last_.empty()) return;
        last_ = impulsesOf(flow.numbers());
        last_.push_back(flow.time.value());
    }

    void execute(FlowView& flow) override
    {
        const double now = flow.time.value();
        const std::vector<double> impulses = impulsesOf(flow.numbers());
        const double passed = now - last_.back();
        std::vector<CsvFile::Cell> row{now};
        std::ostringstream text;
        for (std::size_t k = 0; k < impulses.size(); ++k) row.emplace_back((impulses[k] - last_[k]) / passed);
        for (std::size_t w = 0; w < walls_.size(); ++w)
        {
            Vector3 force;
            for (int part = 0; part < WallReactions::parts; ++part)
            {
                for (int c = 0; c < 3; ++c) force[c] += std::get<double>(row[1 + (w * WallReactions::parts + part) * 6 + c]);
            }
            text << (w > 0 ? ", " : "") << "force on " << walls_[w] << " (" << force.x << ' ' << force.y << ' ' << force.z << ") N";
        }
        report_ = text.str();
        table_.addRow(row);
        last_ = impulses;
        last_.push_back(now);
    }

    KeptNumbers state(double) const override { return last_.empty() ? KeptNumbers() : KeptNumbers{{"last", last_}}; }
    void goOn(const KeptNumbers& kept, double) override
    {
        const auto last = kept.find("last");
        if (last != kept.end() && last->second.size() == walls_.size() * WallReactions::parts * 6 + 1) last_ = last->second;
    }

    bool looksAtWallReactions() const override { return true; }
    bool looksAtDensities() const override { return false; }
    bool looksAtParticles() const override { return false; }
    std::string needsOfRun() const override { return "the impulses that walls get in each step"; }
    std::string report() const override { return report_; }
    const CsvFile* table() const override { return &table_; }

private:
    static std::vector<CsvFile::Column> columns(const std::vector<std::string>& walls)
    {
        std::vector<CsvFile::Column> columns{{"time", "s"}};
        for (const std::string& wall : walls)
        {
            for (const std::string part : WallReactions::partNames)
            {
                for (const char axis : {'X', 'Y', 'Z'}) columns.push_back({wall + "_" + part + "Force" + axis, "N"});
                for (const char axis : {'X', 'Y', 'Z'}) columns.push_back({wall + "_" + part + "Moment" + axis, "N m"});
            }
        }
        return columns;
    }

    // In the order of the columns, moments about CofR.
    std::vector<double> impulsesOf(const std::map<std::string, double>& numbers) const
    {
        std::vector<double> impulses;
        for (const std::string& wall : walls_)
        {
            for (int part = 0; part < WallReactions::parts; ++part)
            {
                double of[6];
                for (int c = 0; c < 6; ++c)
                {
                    const auto found = numbers.find(WallReactions::number(wall, WallReactions::Part(part), c));
                    of[c] = found == numbers.end() ? 0 : found->second;
                }
                const Vector3 impulse{of[0], of[1], of[2]}, moment = Vector3{of[3], of[4], of[5]} - cross(centre_, impulse);
                for (const Vector3& v : {impulse, moment}) impulses.insert(impulses.end(), {v.x, v.y, v.z});
            }
        }
        return impulses;
    }

    Vector3 centre_;
    std::vector<std::string> walls_;
    std::vector<double> last_;              // impulses and time [s] of the last row
    std::string report_;
    CsvFile table_;
};

const FunctionObjectTable::Add<WallForces> registered{"wallForces", "force and moment of the liquid on each wall"};

}

}
