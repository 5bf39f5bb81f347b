// SPDX-License-Identifier: GPL-3.0-or-later
#include "stepping/Balance.H"

#include "core/messages/Error.H"
#include "device/Algorithms.H"
#include "device/ForEach.H"
#include "device/Gather.H"
#include "motion/Motion.H"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

namespace shizuku
{

namespace
{

struct Row
{
    int y, z;

    HOST_DEVICE bool operator==(const Row& other) const { return y == other.y && z == other.z; }
};

struct RowOf
{
    CellGridView grid;
    Span<const Position> x;
    Span<Row> row;

    HOST_DEVICE void operator()(int i) const
    {
        const CellPlace cell = grid.cellPlace(x[i]);
        row[i] = {cell.y, cell.z};
    }
};

// Whether a particle is in another row than the one before it.
struct BeginsRow
{
    Span<const Row> row;
    Span<std::uint8_t> is;

    HOST_DEVICE void operator()(int i) const { is[i] = i == 0 || !(row[i] == row[i - 1]); }
};

// Of the owned particles. They are sorted by cells, nearly, so that most of a row lie behind each other.
RowLoads countRows(const Liquid& liquid, const Neighbourhood& near)
{
    const int n = liquid.owned();
    if (n == 0) return {};
    Buffer<Row> row(n);
    forEach(n, RowOf{near.grid().view(), liquid.position.span(), row.span()});
    Buffer<std::uint8_t> begins(n);
    forEach(n, BeginsRow{row.span(), begins.span()});
    Selection selection;
    Readback count;
    select(begins, selection, n, count);
    const int runs = int(*count.wait());
    std::vector<std::uint32_t> first(runs + 1, std::uint32_t(n));
    selection.indices.download(first.data(), runs);
    Buffer<Row> rowOfRun;
    gather(row, Buffer<std::uint32_t>(std::vector<std::uint32_t>(first.begin(), first.end() - 1)), rowOfRun);
    const std::vector<Row> rows = rowOfRun.download();
    RowLoads loads;
    for (int k = 0; k < runs; ++k) loads.push_back({rows[k].y, rows[k].z, std::int64_t(first[k + 1]) - std::int64_t(first[k])});
    return sortedLoads(std::move(loads));
}

// The largest part over the average; where parts have weights, by these.
double imbalance(const std::vector<std::int64_t>& particles, const std::vector<double>& weights)
{
    double all = 0, allWeights = 0, largest = 0;
    for (std::size_t k = 0; k < particles.size(); ++k)
    {
        const double weight = weights.empty() ? 1 : weights[k];
        all += double(particles[k]);
        allWeights += weight;
        largest = std::max(largest, double(particles[k]) / weight);
    }
    return all > 0 ? largest * allWeights / all : 1;
}

const char* directionsOf(const RowCut& cut)
{
    if (!cut.isAcross(true)) return "y";
    return cut.isAcross(false) ? "y and z" : "z";
}

bool isWhole(double number) { return number >= 1 && number <= 1e6 && number == std::floor(number); }

}

// Words of OpenFOAM are told apart from others: they have a reason.
void BalanceControls::readMethod(const Dictionary& dict)
{
    const std::vector<std::string> known{"bisection", "rows", "simple", "hierarchical"};
    const std::vector<std::string> ofOpenFoam{"kahip", "manual", "metis", "multiLevel", "none", "random", "scotch", "structured", "zoltan"};
    const std::string word = dict.lookupOr<std::string>("method", known[0]);
    if (std::find(ofOpenFoam.begin(), ofOpenFoam.end(), word) != ofOpenFoam.end())
    {
        throw FatalInputError
        (
            dict.where("method"), "The method '" + word + "' cuts a mesh; liquid moves, and is cut between rows of cells alone", "", known, word
        );
    }
    const std::string chosen = dict.lookupChoiceOr("method", known, known[0]);
    method = Method(std::find(known.begin(), known.end(), chosen) - known.begin());
    if (method == Method::simple) readPieces(dict.subDict("simpleCoeffs"));
    if (method == Method::hierarchical)
    {
        const Dictionary coeffs = dict.subDict("hierarchicalCoeffs");
        readPieces(coeffs);
        const std::string order = coeffs.lookupChoiceOr("order", {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx"}, "xyz");
        zFirst = order.find('z') < order.find('y');
    }
    const std::string direction = dict.lookupChoiceOr("direction", {"y", "z", "auto"}, "auto");
    if (direction == "auto") return;
    if (method != Method::rows)
    {
        throw FatalInputError(dict.where("direction"), "The method " + chosen + " chooses directions by itself", "method rows, or no direction");
    }
    zFirst = direction == "z";
}

// As OpenFOAM has it: so many parts along each axis.
void BalanceControls::readPieces(const Dictionary& coeffs)
{
    const auto n = coeffs.lookup<std::array<double, 3>>("n");
    if (!std::all_of(n.begin(), n.end(), isWhole) || n[0] > 1)
    {
        throw FatalInputError(coeffs.where("n"), "The liquid cannot be cut so: rows of cells along x stay whole", "(1 M N), M times N parts");
    }
    const long all = std::lround(n[1] * n[2]);
    if (parts && *parts != all)
    {
        throw FatalInputError(coeffs.where("n"), "These are " + std::to_string(all) + " parts, and numberOfSubdomains is " + std::to_string(*parts), "as many");
    }
    parts = all;
    alongY = int(n[1]);
    alongZ = int(n[2]);
}

void BalanceControls::readWeights(const Dictionary& dict)
{
    if (!dict.found("processorWeights")) return;
    weights = dict.lookup<std::vector<double>>("processorWeights");
    const bool allPositive = std::all_of(weights.begin(), weights.end(), [](double weight) { return weight > 0 && std::isfinite(weight); });
    if (!allPositive || weights.empty())
    {
        throw FatalInputError(dict.where("processorWeights"), "Each part is to have some liquid", "a positive number for each part: (1 1 2 2)");
    }
    if (method == Method::simple)
    {
        throw FatalInputError(dict.where("processorWeights"), "Cuts of the method simple go through all parts", "method bisection, rows or hierarchical");
    }
    if (parts && *parts != long(weights.size()))
    {
        throw FatalInputError
        (
            dict.where("processorWeights"), "These are weights of " + std::to_string(weights.size()) + " parts, and there are " + std::to_string(*parts), "as many"
        );
    }
    parts = long(weights.size());
}

BalanceControls BalanceControls::read(const std::filesystem::path& casePath)
{
    BalanceControls controls;
    const auto file = casePath / "system/decomposeParDict";
    if (!std::filesystem::exists(file)) return controls;
    const Dictionary dict = Dictionary::read(file);
    if (dict.found("numberOfSubdomains")) controls.parts = dict.lookup<long>("numberOfSubdomains");
    controls.readMethod(dict);
    controls.readWeights(dict);
    controls.rebalanceAbove = dict.lookupOr("rebalanceAbove", controls.rebalanceAbove);
    if (!(controls.rebalanceAbove >= 0))
    {
        throw FatalInputError(dict.where("rebalanceAbove"), "The share is negative", "0 or more, 0.1 for a tenth");
    }
    const double interval = dict.lookupOr("rebalanceInterval", double(controls.interval));
    if (!isWhole(interval))
    {
        throw FatalInputError(dict.where("rebalanceInterval"), "These are no steps", "a whole number, 5 for every fifth step");
    }
    controls.interval = int(interval);
    controls.sameBits = dict.lookupOr("sameBits", controls.sameBits);
    dict.refuseUnused();
    return controls;
}

RowCut Balance::cutOf(const RowLoads& loads, int parts) const
{
    switch (controls_.method)
    {
        case BalanceControls::Method::rows: return cutPencils(loads, parts, 1, *controls_.zFirst, controls_.weights);
        case BalanceControls::Method::simple: return cutStraight(loads, controls_.alongY, controls_.alongZ);
        case BalanceControls::Method::hierarchical:
        {
            const int outer = *controls_.zFirst ? controls_.alongZ : controls_.alongY;
            return cutPencils(loads, outer, parts / outer, *controls_.zFirst, controls_.weights);
        }
        case BalanceControls::Method::bisection: break;
    }
    return cutBisected(loads, parts, controls_.weights);
}

void Balance::begin(Liquid& liquid, Neighbourhood& near)
{
    const Communicator& parts = liquid.parts();
    if (controls_.parts && *controls_.parts != parts.parts())
    {
        throw FatalInputError
        (
            {}, "system/decomposeParDict has " + std::to_string(*controls_.parts) + " parts, and there are " + std::to_string(parts.parts()) + " processes",
            "mpirun -np " + std::to_string(*controls_.parts) + ", or no number of parts there"
        );
    }
    const RowLoads loads = addUp(countRows(liquid, near), parts);
    if (!controls_.zFirst) controls_.zFirst = isLongerAlongZ(loads);
    cut_ = cutOf(loads, parts.parts());
    const std::vector<std::int64_t> particles = cut_.particles(loads);
    if (const auto empty = std::count(particles.begin(), particles.end(), 0))
    {
        warning
        (
            std::to_string(empty) + " of " + std::to_string(parts.parts()) + " parts have no liquid: it lies in " + std::to_string(loads.size())
          + " rows of cells, which stay whole"
        );
    }
    near.cut(cut_);
    predictPositions(liquid, 0);
    near.search(liquid, 0);
    const std::string link = liquid.ghosts().linkName();
    std::cout << "Parts  : " << parts.parts() << ", cut across " << directionsOf(cut_) << ", the largest " << imbalance(particles, controls_.weights)
              << " of the average" << (link.empty() ? "" : ", linked by " + link) << std::endl;
}

void Balance::keep(const Liquid& liquid, Neighbourhood& near)
{
    const Communicator& parts = liquid.parts();
    if (parts.parts() == 1 || ++steps_ < pause_ * controls_.interval) return;
    steps_ = 0;
    const double before = imbalance(parts.gather(std::int64_t(liquid.owned())), controls_.weights);
    if (before <= 1 + controls_.rebalanceAbove) return;
    const RowLoads loads = addUp(countRows(liquid, near), parts);
    const RowCut anew = cutOf(loads, cut_.parts());
    const double after = imbalance(anew.particles(loads), controls_.weights);
    constexpr double worthwhile = 0.75;         // of what is too much
    if (after - 1 > worthwhile * (before - 1))  // rows are too coarse: what is looked at in vain is looked at less often
    {
        constexpr int longest = 64;
        pause_ = std::min(2 * pause_, longest);
        return;
    }
    pause_ = 1;
    cut_ = anew;
    near.cut(cut_);
    std::cout << "\nThe liquid is cut anew: the largest part had " << before << " of the average, now " << after << std::endl;
}

}
