// SPDX-License-Identifier: GPL-3.0-or-later
// Values of the liquid at fixed points over time, interpolated by the kernel (Shepard 1968):
//
//     A(x) = sum_j (m_j/rho_j) A_j W(|x - x_j|) / sum_j (m_j/rho_j) W(|x - x_j|)
//
//     gauges
//     {
//         type            probes;
//         fields          (rho U p);
//         probeLocations  ((0 0 1e-3) (0 0 2e-3));        // m
//     }
//
// rho [kg/m3], U [m/s], p [Pa] (where the pressure model has one; see Pressure::keepPressure). A row a probe: its number,
// its place, `fill`, the share of the kernel that liquid fills (1 inside, 1/2 on the surface), and the values; they are
// not numbers where no liquid is within the kernel's support.

#include "core/fieldFile/CsvFile.H"
#include "device/Reduce.H"
#include "functionObjects/FunctionObject.H"
#include "maths/WholeSum.H"

#include <algorithm>
#include <utility>

namespace shizuku
{

namespace
{

// Of whole quanta: the same in any order, and of any parts.
struct ProbeSums
{
    WideSum fill, weight, density, pressure, velocity[3];

    HOST_DEVICE void add(const ProbeSums& other)
    {
        fill += other.fill;
        weight += other.weight;
        density += other.density;
        pressure += other.pressure;
        for (int c = 0; c < 3; ++c) velocity[c] += other.velocity[c];
    }
};

template<class Kernel>
struct Weighted
{
    Kernel W;
    Position point;
    Span<const Position> position;
    Span<const Vec3> velocity;
    Span<const scalar> density, pressure;      // pressure: may be empty

    HOST_DEVICE ProbeSums operator()(int j) const
    {
        ProbeSums sums;
        const Vec3 r = point - position[j];
        if (squared(r) >= W.h * W.h || !isSameImage(point, position[j])) return sums;
        const double W_j = W.W(norm(r));
        if (W_j == 0) return sums;
        const double weight = W_j / density[j];
        sums.fill = wideQuanta(W_j);
        sums.weight = wideQuanta(weight);
        sums.density = wideQuanta(weight * density[j]);
        if (pressure.size > 0) sums.pressure = wideQuanta(weight * pressure[j]);
        sums.velocity[0] = wideQuanta(weight * velocity[j].x);
        sums.velocity[1] = wideQuanta(weight * velocity[j].y);
        sums.velocity[2] = wideQuanta(weight * velocity[j].z);
        return sums;
    }
};

class Probes : public FunctionObject
{
public:
    Probes(const Dictionary& dict, const FunctionSetting& setting)
    :
        fields_(readFields(dict)), where_(dict.where("fields")),
        places_(dict.lookup<std::vector<std::array<double, 3>>>("probeLocations")),
        table_(setting.folder / "probes.csv", columns())
    {
        if (places_.empty()) throw FatalInputError(dict.where("probeLocations"), "There is no probe", "one place at least");
    }

    void execute(FlowView& flow) override
    {
        for (std::size_t probe = 0; probe < places_.size(); ++probe)
        {
            const ProbeSums sums = flow.parts().fold(sumsAt(flow.part(), places_[probe]));
            if (flow.parts().part() == 0) table_.addRow(row(flow, probe, sums));
        }
    }

    bool measuresInParts() const override { return true; }
    const CsvFile* table() const override { return &table_; }

    std::string needsOfRun() const override { return asked("p") ? "the pressure p, which is not read from stored times" : ""; }

    void modelsMade(FlowView& flow) override
    {
        if (!asked("p")) return;
        const bool atStart = flow.subStep() == 0;
        pressure_ = flow.models.pressure->keepPressure() != nullptr;
        if (pressure_ || !atStart) return;             // a model without pressure in the middle of a run: no numbers
        throw FatalInputError(where_, "The pressure model of constant/models has no pressure p", "rho, U; or pressure pbf");
    }

private:
    static std::vector<std::string> readFields(const Dictionary& dict)
    {
        const std::vector<std::string> known{"rho", "U", "p"};
        const auto fields = dict.lookup<std::vector<std::string>>("fields");
        const auto refuse = [&](const std::string& found, const std::string& field)
        {
            throw FatalInputError(dict.where("fields"), found, "some of the fields below, each once", known, field);
        };
        if (fields.empty()) refuse("There is no field", "");
        for (const std::string& field : fields)
        {
            if (std::find(known.begin(), known.end(), field) == known.end()) refuse("There is no field '" + field + "'", field);
            if (std::count(fields.begin(), fields.end(), field) > 1) refuse("The field '" + field + "' is named twice", "");
        }
        return fields;
    }

    bool asked(const std::string& field) const { return std::find(fields_.begin(), fields_.end(), field) != fields_.end(); }

    std::vector<CsvFile::Column> columns() const
    {
        std::vector<CsvFile::Column> result{{"time", "s"}, {"probe", ""}, {"x", "m"}, {"y", "m"}, {"z", "m"}, {"fill", ""}};
        if (asked("rho")) result.push_back({"rho", "kg/m3"});
        if (asked("U")) result.insert(result.end(), {{"Ux", "m/s"}, {"Uy", "m/s"}, {"Uz", "m/s"}});
        if (asked("p")) result.push_back({"p", "Pa"});
        return result;
    }

    std::vector<CsvFile::Cell> row(FlowView& flow, std::size_t probe, const ProbeSums& sums) const
    {
        const Liquid& liquid = flow.part();
        const auto& x = places_[probe];
        // 0/0 where there is no liquid: not a number
        const double weight = valueOf(sums.weight), velocity = liquid.units().of(dimensions::velocity) / weight;
        const double rho0 = flow.properties().density, pascal = liquid.units().of(dimensions::pressure);
        std::vector<CsvFile::Cell> cells{flow.time.value(), double(probe), x[0], x[1], x[2]};
        cells.emplace_back(valueOf(sums.fill) * liquid.particleVolume() / liquid.latticeSum());
        if (asked("rho")) cells.emplace_back(rho0 * valueOf(sums.density) / weight);
        if (asked("U")) for (const WideSum& u : sums.velocity) cells.emplace_back(valueOf(u) * velocity);
        if (asked("p")) cells.emplace_back(pressure_ ? pascal * valueOf(sums.pressure) / weight : NAN);
        return cells;
    }

    ProbeSums sumsAt(const Liquid& liquid, const std::array<double, 3>& place)
    {
        const double unit = liquid.units().length;
        const Position point = positionAt(place[0] / unit, place[1] / unit, place[2] / unit);
        return std::visit
        (
            [&]<class Kernel>(const Kernel& W)
            {
                return reduce
                (
                    liquid.owned(),
                    Weighted<Kernel>
                    {
                        W, point, liquid.position.span(), liquid.velocity.span(), liquid.density.span(),
                        pressure_ ? pressureOf(liquid) : Span<const scalar>{}
                    },
                    scratch_
                );
            },
            liquid.kernel()
        );
    }

    // The field that the model keeps.
    static Span<const scalar> pressureOf(const Liquid& liquid)
    {
        const auto& entries = liquid.fields().entries();
        const auto found = std::find_if(entries.begin(), entries.end(), [](const auto& entry) { return entry->info.name == "p"; });
        return std::get<Buffer<scalar>>(std::as_const((*found)->values)).span();
    }

    std::vector<std::string> fields_;
    SourceLocation where_;
    std::vector<std::array<double, 3>> places_;         // m
    CsvFile table_;
    bool pressure_ = false;             // the model has one
    Buffer<ProbeSums> scratch_;
};

const FunctionObjectTable::Add<Probes> registered{"probes", "values of the liquid at fixed points"};

}

}
