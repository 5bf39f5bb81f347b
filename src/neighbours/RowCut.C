// SPDX-License-Identifier: GPL-3.0-or-later
#include "neighbours/RowCut.H"

#include "core/messages/Error.H"
#include "parallel/AllParts.H"

#include <cstdlib>
#include <string>

namespace shizuku
{

ParticlesOfRows addUp(const ParticlesOfRows& own, const Communicator& parts)
{
    struct Row
    {
        std::int64_t row, particles;
    };
    std::vector<Row> list;
    for (const auto& [row, particles] : own) list.push_back({row, particles});
    ParticlesOfRows all;
    for (const Row& each : gatherLists(parts, list)) all[int(each.row)] += each.particles;
    return all;
}

RowCut cutEvenly(const ParticlesOfRows& rows, int parts, bool acrossZ)
{
    if (parts < 1 || parts > RowCut::mostParts)
    {
        throw FatalError("A liquid cannot be cut into " + std::to_string(parts) + " parts: 1 to " + std::to_string(RowCut::mostParts) + " are possible");
    }
    std::int64_t all = 0;
    for (const auto& [row, particles] : rows) all += particles;
    RowCut cut{parts, acrossZ, {}};
    int part = 1;
    std::int64_t before = 0;
    const auto wanted = [&] { return all * part / parts; };
    for (const auto& [row, particles] : rows)
    {
        // In front of this row, or behind it: whichever is nearer to what is wanted.
        while (part < parts && 2 * wanted() < 2 * before + particles) cut.first[part++] = row;
        before += particles;
    }
    while (part < parts && !rows.empty()) cut.first[part++] = rows.rbegin()->first + 1;
    return cut;
}

RowCut cutEvenly(const std::vector<int>& rows, int parts, bool acrossZ)
{
    ParticlesOfRows counts;
    for (const int row : rows) ++counts[row];
    return cutEvenly(counts, parts, acrossZ);
}

}
