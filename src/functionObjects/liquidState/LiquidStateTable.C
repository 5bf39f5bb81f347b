// The liquid as a whole over time: volume, kinetic energy, largest speed, centroid, momentum, density error.
//
//     drop { type liquidState; }

#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"

namespace shizuku
{

namespace
{

class LiquidStateTable : public FunctionObject
{
public:
    LiquidStateTable(const Dictionary&, const FunctionSetting& setting)
    :
        table_
        (
            setting.folder / "liquidState.csv",
            {
                {"time", "s"}, {"volume", "m3"}, {"kineticEnergy", "J"}, {"maxSpeed", "m/s"},
                {"centroidX", "m"}, {"centroidY", "m"}, {"centroidZ", "m"},
                {"momentumX", "kg m/s"}, {"momentumY", "kg m/s"}, {"momentumZ", "kg m/s"},
                {"averageDensityError", ""}, {"maxDensityError", ""}
            }
        )
    {}

    void execute(FlowView& flow) override
    {
        const LiquidState& state = flow.state();
        const auto& x = state.centroid;
        const auto& m = state.momentum;
        table_.addRow
        ({
            flow.time.value(), state.volume, state.kineticEnergy, state.maxSpeed, x[0], x[1], x[2], m[0], m[1], m[2],
            state.averageDensityError, state.maxDensityError
        });
    }

    WriteJob writing() override { return table_.writing(); }

private:
    CsvFile table_;
};

const FunctionObjectTable::Add<LiquidStateTable> registered{"liquidState"};

}

}
