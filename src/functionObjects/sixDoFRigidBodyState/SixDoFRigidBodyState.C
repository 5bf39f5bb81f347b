// SPDX-License-Identifier: GPL-3.0-or-later
// Where the body is that the liquid moves, and how fast, over time.
//
//     ball { type sixDoFRigidBodyState; }
//
// centre and velocity of the centre of mass; omega, its rate of rotation.

#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"
#include "wallMotions/SixDoFBody.H"
#include "wallMotions/WallMotions.H"

#include <sstream>

namespace shizuku
{

namespace
{

class SixDoFRigidBodyState : public FunctionObject
{
public:
    SixDoFRigidBodyState(const Dictionary& dict, const FunctionSetting& setting)
    :
        motions_(WallMotions::read(setting.casePath)), table_(setting.folder / "sixDoFRigidBodyState.csv", columns())
    {
        if (!motions_.body()) throw FatalInputError(dict.where(), "The liquid moves no body in this case", "a wall of constant/walls with a motion of type sixDoF");
    }

    void execute(FlowView& flow) override
    {
        SixDoFBody& body = *motions_.body();
        if (flow.numbers().contains(body.wall() + "_time"))
        {
            SixDoFState state;
            SixDoFState::forEach(state, body.wall(), [&](const std::string& name, double& number) { number = flow.numbers().at(name); });
            body.goOn(state);
        }
        else body.begin(flow.time.value());
        const Vector3 centre = body.centre(), velocity = body.state().velocity, omega = body.state().omega;
        std::vector<CsvFile::Cell> row{flow.time.value()};
        for (const Vector3& v : {centre, velocity, omega}) row.insert(row.end(), {v.x, v.y, v.z});
        table_.addRow(row);
        std::ostringstream text;
        text << "centre of " << body.wall() << " (" << centre.x << ' ' << centre.y << ' ' << centre.z << ") m, velocity (" << velocity.x << ' ' << velocity.y << ' ' << velocity.z << ") m/s";
        report_ = text.str();
    }

    bool looksAtDensities() const override { return false; }
    bool looksAtParticles() const override { return false; }
    std::string report() const override { return report_; }
    const CsvFile* table() const override { return &table_; }

private:
    static std::vector<CsvFile::Column> columns()
    {
        return
        {
            {"time", "s"}, {"centreX", "m"}, {"centreY", "m"}, {"centreZ", "m"}, {"velocityX", "m/s"}, {"velocityY", "m/s"}, {"velocityZ", "m/s"},
            {"omegaX", "rad/s"}, {"omegaY", "rad/s"}, {"omegaZ", "rad/s"}
        };
    }

    WallMotions motions_;
    std::string report_;
    CsvFile table_;
};

const FunctionObjectTable::Add<SixDoFRigidBodyState> registered{"sixDoFRigidBodyState", "place and velocity of the body that the liquid moves"};

}

}
