// SPDX-License-Identifier: GPL-3.0-or-later
// type volume;  within 0.5;
// The liquid's volume at the end against the volume of its particles, N d^3, by two measures that do not know of each
// other: the closed surface mesh, and the crowding of the particles (liquidState's sum of V/max(rho/rho0, 1)); and the
// mesh at the end against that at the start. within: percent.

#include "Comparison.H"

namespace shizuku
{

static std::vector<ComparisonRow> compareVolume(const CaseResults& results, double within)
{
    const double exact = results.liquidVolume();
    const double mesh = results.surface(results.times().back()).volume();
    const double first = results.surface(results.times().front()).volume();
    const CsvTable states = results.table("drop", "liquidState.csv");
    return
    {
        relativeRow("volume of the mesh", "m3", exact, mesh, within),
        relativeRow("volume of the mesh since start", "m3", first, mesh, within),
        relativeRow("volume of the particles", "m3", exact, states.number(states.rows() - 1, "volume"), within)
    };
}

static const ComparisonTable::Add<PlainComparison<compareVolume>> registered{"volume"};

}
