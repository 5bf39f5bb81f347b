// SPDX-License-Identifier: GPL-3.0-or-later
// The liquid's energy over time.
//
//     energies { type energy; }
//
// kinetic: sum m u^2/2; gravitational: -M g.x of the centroid x, zero at the origin; surface:
// sigma (A - sum_walls A_wall cos theta), A the free area of the surface mesh and A_wall the wetted one (WettedSurface.H);
// 0 without a model of tension, and not a number where liquid touches walls that have no contact angle in the chosen
// models. total: their sum.

#include "core/angles/Degrees.H"
#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"

#include <cmath>
#include <limits>

namespace shizuku
{

namespace
{

class Energy : public FunctionObject
{
public:
    Energy(const Dictionary&, const FunctionSetting& setting)
    :
        table_
        (
            setting.folder / "energy.csv",
            {{"time", "s"}, {"kinetic", "J"}, {"gravitational", "J"}, {"surface", "J"}, {"total", "J"}}
        )
    {
        setting.requireSurface();
    }

    void modelsMade(FlowView& flow) override { flow.prepareContacts(); }

    void execute(FlowView& flow) override
    {
        const LiquidState& state = flow.state();
        const auto g = flow.models.bodyForce->uniform();
        const double mass = flow.particles() * flow.properties().particleMass();
        const double potential = 0 - mass * dot(Vector3(g), Vector3(state.centroid));       // 0, not -0, without gravity
        const double surface = flow.models.forces.active() ? flow.properties().surfaceTension * tensionArea(flow) : 0;
        if (flow.parts().part() > 0) return;
        table_.addRow
        ({
            flow.time.value(), state.kineticEnergy, potential, surface, state.kineticEnergy + potential + surface
        });
    }

    bool measuresInParts() const override { return true; }
    bool looksAtSurface() const override { return true; }
    const CsvFile* table() const override { return &table_; }

private:
    // Free area less the wetted area times cos theta, m2.
    double tensionArea(FlowView& flow) const
    {
        const auto& angles = flow.walls.angles();
        Sum area;
        for (const WettedSurface::Contact& contact : flow.contacts())
        {
            if (contact.wall < 0) area.value += contact.area;
            else if (!angles) area.value = std::numeric_limits<double>::quiet_NaN();
            else area.value -= contact.area * std::cos(radians(contact.solid < 0 ? angles->surfaces[contact.wall] : angles->particles[contact.solid]));
        }
        return flow.parts().fold(area).value;
    }

    struct Sum
    {
        double value = 0;
        void add(const Sum& other) { value += other.value; }
    };

    CsvFile table_;
};

const FunctionObjectTable::Add<Energy> registered{"energy", "kinetic, surface and potential energy"};

}

}
