// SPDX-License-Identifier: GPL-3.0-or-later
#include "LargestDrops.H"

#include "core/messages/Error.H"

namespace shizuku
{

LargestDrops LargestDrops::read(const CaseResults& results)
{
    const LargestDrops drops(results.table("probeAngle", "angle.csv"));
    if (drops.times() == 0) throw FatalInputError({results.casePath().string(), 0}, "probeAngle found no drop");
    return drops;
}

std::optional<LargestDrops> LargestDrops::find(const CaseResults& results)
{
    if (!std::filesystem::exists(results.casePath()/"postProcessing/probeAngle")) return {};
    const LargestDrops drops(results.table("probeAngle", "angle.csv"));
    return drops.times() > 0 ? std::optional(drops) : std::nullopt;
}

LargestDrops::LargestDrops(const CsvTable& drops) : drops_(drops)
{
    for (std::size_t row = 0; row < drops_.rows(); ++row)
    {
        if (row == 0 || drops_.text(row, "time") != drops_.text(row - 1, "time")) rows_.push_back(row);
        else if (drops_.number(row, "volume") > drops_.number(rows_.back(), "volume")) rows_.back() = row;
    }
}

double LargestDrops::angle(std::size_t time) const
{
    const std::string now = state(time);
    return now == "film" ? 0 : now == "detached" ? 180 : number(time, "angle");
}

int LargestDrops::piecesAtLast() const
{
    int pieces = 0;
    for (std::size_t row = 0; row < drops_.rows(); ++row)
    {
        if (drops_.text(row, "time") == drops_.text(drops_.rows() - 1, "time")) ++pieces;
    }
    return pieces;
}

}
