// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/Balance.H"

#include "core/messages/Error.H"
#include "device/ForEach.H"
#include "motion/Motion.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

namespace shizuku
{

namespace
{

struct RowOf
{
    CellGridView grid;
    RowCut cut;
    Span<const Position> x;
    Span<std::uint32_t> row;

    HOST_DEVICE void operator()(int i) const { row[i] = std::uint32_t(cut.rowOf(grid.cellPlace(x[i]))); }
};

// Of the owned particles.
std::vector<std::uint32_t> rowsOf(const Liquid& liquid, const Neighbourhood& near, const RowCut& cut)
{
    Buffer<std::uint32_t> rows(liquid.owned());
    forEach(liquid.owned(), RowOf{near.grid().view(), cut, liquid.position.span(), rows.span()});
    return rows.download();
}

ParticlesOfRows countRows(const std::vector<std::uint32_t>& rows)
{
    ParticlesOfRows counts;
    for (const std::uint32_t row : rows) ++counts[int(row)];
    return counts;
}

// The largest part over the average.
double imbalance(std::vector<std::int64_t> particles)
{
    std::int64_t all = 0;
    for (const std::int64_t of : particles) all += of;
    return all > 0 ? double(*std::max_element(particles.begin(), particles.end())) * double(particles.size()) / double(all) : 1;
}

double imbalance(const ParticlesOfRows& rows, const RowCut& cut)
{
    std::vector<std::int64_t> particles(cut.parts);
    for (const auto& [row, count] : rows) particles[cut.partOf(row)] += count;
    return imbalance(particles);
}

// Words of OpenFOAM are told apart from others: they have a reason.
std::string readMethod(const Dictionary& dict)
{
    const std::vector<std::string> known{"rows", "simple"}, ofOpenFoam{"hierarchical", "kahip", "manual", "metis", "multiLevel", "none", "scotch", "structured"};
    const std::string method = dict.lookupOr<std::string>("method", "rows");
    if (std::find(ofOpenFoam.begin(), ofOpenFoam.end(), method) == ofOpenFoam.end()) return dict.lookupChoiceOr("method", known, "rows");
    throw FatalInputError
    (
        dict.where("method"), "The method '" + method + "' cuts a mesh; liquid moves, and is cut between rows of cells alone", "", known, method
    );
}

const char* directionOf(const RowCut& cut) { return cut.acrossZ ? "z" : "y"; }

}

// As OpenFOAM has it: so many parts along each axis.
void BalanceControls::readSimple(const Dictionary& dict)
{
    const Dictionary coeffs = dict.subDict("simpleCoeffs");
    const auto n = coeffs.lookup<std::array<double, 3>>("n");
    const bool whole = std::all_of(n.begin(), n.end(), [](double parts) { return parts >= 1 && parts <= RowCut::mostParts && parts == std::floor(parts); });
    if (!whole || n[0] > 1 || (n[1] > 1 && n[2] > 1))
    {
        throw FatalInputError
        (
            coeffs.where("n"), "The liquid cannot be cut so: rows of cells along x stay whole, and cuts lie across one direction", "(1 N 1) or (1 1 N), N parts"
        );
    }
    const long all = std::lround(n[1] * n[2]);
    if (parts && *parts != all)
    {
        throw FatalInputError(coeffs.where("n"), "These are " + std::to_string(all) + " parts, and numberOfSubdomains is " + std::to_string(*parts), "as many");
    }
    parts = all;
    if (all > 1) acrossZ = n[2] > 1;
}

BalanceControls BalanceControls::read(const std::filesystem::path& casePath)
{
    BalanceControls controls;
    const auto file = casePath / "system/decomposeParDict";
    if (!std::filesystem::exists(file)) return controls;
    const Dictionary dict = Dictionary::read(file);
    if (dict.found("numberOfSubdomains")) controls.parts = dict.lookup<long>("numberOfSubdomains");
    if (readMethod(dict) == "simple") controls.readSimple(dict);
    const std::string direction = dict.lookupChoiceOr("direction", {"y", "z", "auto"}, "auto");
    if (direction != "auto" && controls.acrossZ.value_or(direction == "z") != (direction == "z"))
    {
        throw FatalInputError(dict.where("direction"), "The direction is " + direction + ", and simpleCoeffs cut across the other one", "one of the two");
    }
    if (direction != "auto") controls.acrossZ = direction == "z";
    controls.rebalanceAbove = dict.lookupOr("rebalanceAbove", controls.rebalanceAbove);
    if (!(controls.rebalanceAbove >= 0))
    {
        throw FatalInputError(dict.where("rebalanceAbove"), "The share is negative", "0 or more, 0.1 for a tenth");
    }
    controls.sameBits = dict.lookupOr("sameBits", controls.sameBits);
    dict.refuseUnused();
    return controls;
}

void Balance::begin(Liquid& liquid, Neighbourhood& near)
{
    const Communicator& parts = liquid.parts();
    if (parts.parts() > RowCut::mostParts)
    {
        throw FatalInputError
        (
            {}, "The liquid cannot be cut into " + std::to_string(parts.parts()) + " parts",
            std::to_string(RowCut::mostParts) + " at most: mpirun -np " + std::to_string(RowCut::mostParts)
        );
    }
    if (controls_.parts && *controls_.parts != parts.parts())
    {
        throw FatalInputError
        (
            {}, "system/decomposeParDict has " + std::to_string(*controls_.parts) + " parts, and there are " + std::to_string(parts.parts()) + " processes",
            "mpirun -np " + std::to_string(*controls_.parts) + ", or no number of parts there"
        );
    }
    const auto counts = [&](bool acrossZ) { return addUp(countRows(rowsOf(liquid, near, {1, acrossZ})), parts); };
    const bool acrossZ = controls_.acrossZ ? *controls_.acrossZ : counts(true).size() > counts(false).size();
    const ParticlesOfRows rows = counts(acrossZ);
    cut_ = cutEvenly(rows, parts.parts(), acrossZ);
    if (rows.size() < std::size_t(parts.parts()))
    {
        warning("There are " + std::to_string(parts.parts()) + " parts and " + std::to_string(rows.size()) + " rows of cells with liquid: some parts have none");
    }
    near.cut(cut_);
    predictPositions(liquid, 0);
    near.search(liquid, 0);
    const std::string link = liquid.ghosts().linkName();
    std::cout << "Parts  : " << parts.parts() << ", cut across " << directionOf(cut_) << ", the largest " << imbalance(rows, cut_) << " of the average"
              << (link.empty() ? "" : ", linked by " + link) << std::endl;
}

void Balance::keep(const Liquid& liquid, Neighbourhood& near)
{
    const Communicator& parts = liquid.parts();
    if (parts.parts() == 1 || ++steps_ % interval != 0) return;
    const double before = imbalance(parts.gather(std::int64_t(liquid.owned())));
    if (before <= 1 + controls_.rebalanceAbove) return;
    const ParticlesOfRows rows = addUp(countRows(rowsOf(liquid, near, cut_)), parts);
    const RowCut anew = cutEvenly(rows, cut_.parts, cut_.acrossZ);
    const double after = imbalance(rows, anew);
    if (after >= before) return;                // rows are too coarse
    cut_ = anew;
    near.cut(cut_);
    std::cout << "\nThe liquid is cut anew: the largest part had " << before << " of the average, now " << after << std::endl;
}

}
