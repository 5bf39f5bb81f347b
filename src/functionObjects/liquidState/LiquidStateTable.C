// SPDX-License-Identifier: GPL-3.0-or-later
// The liquid as a whole over time: volume, kinetic energy, largest speed, centroid, momentum, density error; the rms speed
// of its particles, and that over the capillary speed sqrt(sigma/(rho R)), R the radius of a sphere of the liquid's volume
// (not a number without tension).
//
//     drop { type liquidState; }

#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"
#include "reference/FlowNumbers.H"

#include <cmath>

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
                {"averageDensityError", ""}, {"maxDensityError", ""}, {"rmsSpeed", "m/s"}, {"rmsOverCapillary", ""}
            }
        )
    {}

    void execute(FlowView& flow) override
    {
        const LiquidState& state = flow.state();
        const auto& x = state.centroid;
        const auto& m = state.momentum;
        const LiquidProperties& p = flow.properties();
        const double rms = std::sqrt(2 * state.kineticEnergy / (flow.particles() * p.particleMass()));
        const double scale = capillarySpeed(p.surfaceTension, p.density, flow.particles() * p.particleVolume());
        table_.addRow
        ({
            flow.time.value(), state.volume, state.kineticEnergy, state.maxSpeed, x[0], x[1], x[2], m[0], m[1], m[2],
            state.averageDensityError, state.maxDensityError, rms, scale > 0 ? rms / scale : NAN
        });
    }

    bool looksAtParticles() const override { return false; }
    const CsvFile* table() const override { return &table_; }

private:
    CsvFile table_;
};

const FunctionObjectTable::Add<LiquidStateTable> registered{"liquidState", "volume, energy, speeds, centroid, momentum and density error of all liquid"};

}

}
