// SPDX-License-Identifier: GPL-3.0-or-later
// The liquid's energy over time, and where it went.
//
//     energies { type energy; mostMade 0.05; }
//
// kinetic: sum m u^2/2; gravitational: -M g.x of the centroid x, zero at the origin; surface:
// sigma (A - sum_walls A_wall cos theta), A the free area of the surface mesh and A_wall the wetted one (WettedSurface.H);
// 0 without a model of tension, and not a number where liquid touches walls that have no contact angle in the chosen
// models; wetting: the walls' part of it, -sigma sum_walls A_wall cos theta. total: their sum.
// viscosity: what the liquid's viscosity and the friction of walls have taken since the first step; filter: what the model of viscosity has taken besides, as
// noise (motion/ViscousWork.H). Not numbers of stored times of a run without this function object. numerics: by how much total and viscosity have grown since the first measurement.
// That is what the numerics, of which the filter is a part, have made, below 0 taken, and what sources, outlets and walls that move have brought.
// Where numerics is above mostMade times the first sigma A the log says so.

#include "core/angles/Degrees.H"
#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"
#include "motion/ViscousWork.H"

#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace shizuku
{

namespace
{

class Energy : public FunctionObject
{
public:
    Energy(const Dictionary& dict, const FunctionSetting& setting)
    :
        mostMade_(dict.lookupOr("mostMade", 0.05)),
        table_
        (
            setting.folder / "energy.csv",
            {
                {"time", "s"}, {"kinetic", "J"}, {"gravitational", "J"}, {"surface", "J"}, {"wetting", "J"}, {"total", "J"},
                {"viscosity", "J"}, {"numerics", "J"}, {"filter", "J"}
            }
        )
    {
        setting.requireSurface();
        if (!(mostMade_ > 0)) throw FatalInputError(dict.where("mostMade"), "mostMade is not above 0", "a share of the free surface's energy, 0.05 by default");
    }

    void modelsMade(FlowView& flow) override { flow.prepareContacts(); }

    void execute(FlowView& flow) override
    {
        const LiquidState& state = flow.state();
        const auto g = flow.models.bodyForce->uniform();
        const double mass = flow.particles() * flow.properties().particleMass();
        const double potential = 0 - mass * dot(Vector3(g), Vector3(state.centroid));       // 0, not -0, without gravity
        const double sigma = flow.properties().surfaceTension;
        const Areas areas = flow.models.forces.active() ? areasOf(flow) : Areas();
        if (flow.parts().part() > 0) return;
        const double surface = sigma * (areas.free - areas.wetted), total = state.kineticEnergy + potential + surface;
        const double taken = numberOf(flow, ViscousWork::number);
        if (!first_) first_ = {total + taken, sigma * areas.free};
        made_ = total + taken - first_->energy;
        table_.addRow
        ({
            flow.time.value(), state.kineticEnergy, potential, surface, 0 - sigma * areas.wetted, total, taken, made_, numberOf(flow, ViscousWork::ofFilter)
        });
    }

    // What numerics have made counts from the first measurement of the case on.
    KeptNumbers state(double) const override { return first_ ? KeptNumbers{{"first", {first_->energy, first_->surface}}} : KeptNumbers(); }
    void goOn(const KeptNumbers& kept, double) override
    {
        const auto first = kept.find("first");
        if (first != kept.end()) first_ = {first->second.at(0), first->second.at(1)};
    }

    std::string report() const override
    {
        if (!first_ || !(made_ > mostMade_ * first_->surface)) return {};
        std::ostringstream text;
        text << "the numerics have made " << made_ << " J, " << 100 * made_ / first_->surface << " % of the free surface's energy at the start, more than mostMade "
             << 100 * mostMade_ << " %: shorter steps (maxCapillaryCo), or more viscosity, make less";
        return text.str();
    }

    bool looksAtViscousWork() const override { return true; }
    bool measuresInParts() const override { return true; }
    bool looksAtSurface() const override { return true; }
    const CsvFile* table() const override { return &table_; }

private:
    static double numberOf(const FlowView& flow, const char* name)
    {
        const auto found = flow.numbers().find(name);
        return found == flow.numbers().end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
    }

    // m2; of a wetted wall times cos theta.
    struct Areas
    {
        double free = 0, wetted = 0;

        void add(const Areas& other)
        {
            free += other.free;
            wetted += other.wetted;
        }
    };

    Areas areasOf(FlowView& flow) const
    {
        const auto& angles = flow.walls.angles();
        Areas areas;
        for (const WettedSurface::Contact& contact : flow.contacts())
        {
            if (contact.wall < 0) areas.free += contact.area;
            else if (!angles) areas.wetted = std::numeric_limits<double>::quiet_NaN();
            else areas.wetted += contact.area * std::cos(radians(contact.solid < 0 ? angles->surfaces[contact.wall] : angles->particles[contact.solid]));
        }
        return flow.parts().fold(areas);
    }

    struct First
    {
        double energy;                  // J, total and what viscosity had taken
        double surface;                 // J, of the free surface alone
    };

    double mostMade_;
    std::optional<First> first_;
    double made_ = 0;
    CsvFile table_;
};

const FunctionObjectTable::Add<Energy> registered{"energy", "kinetic, surface and potential energy, and what viscosity and numerics took"};

}

}
