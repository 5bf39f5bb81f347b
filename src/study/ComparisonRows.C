// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/ComparisonRows.H"

#include "core/fieldFile/CsvTable.H"

namespace shizuku
{

ComparisonRows::ComparisonRows(const std::filesystem::path& casePath)
{
    const CsvTable table = CsvTable::read(casePath/"postProcessing/compareReference/comparison.csv");
    for (std::size_t row = 0; row < table.rows(); ++row)
    {
        rows_.push_back
        ({
            table.text(row, "comparison"), table.text(row, "quantity"), table.number(row, "reference"),
            table.number(row, "measured"), table.number(row, "deviation"), table.text(row, "deviationUnit")
        });
    }
}

std::optional<ComparedNumber> ComparisonRows::find(const std::string& comparison, const std::string& quantity) const
{
    for (const ComparedNumber& row : rows_)
    {
        if (row.comparison == comparison && row.quantity == quantity) return row;
    }
    return {};
}

ComparedNumber ComparisonRows::require
(
    const std::string& comparison, const std::string& quantity, const SourceLocation& where
) const
{
    if (const auto row = find(comparison, quantity)) return *row;
    std::vector<std::string> there;
    for (const ComparedNumber& row : rows_) there.push_back(row.comparison + ": " + row.quantity);
    throw FatalInputError
    (
        where, "Unknown measure: compareReference gives no '" + quantity + "' of '" + comparison + "'",
        "comparison and quantity of one of its rows", there, comparison + ": " + quantity
    );
}

}
