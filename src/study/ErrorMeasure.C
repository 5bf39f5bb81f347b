// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/ErrorMeasure.H"

#include "core/dictionary/EntryText.H"
#include "core/time/PostProcessing.H"
#include "study/ComparisonRows.H"

#include <cmath>

namespace shizuku
{

namespace
{

double percent(double measured, double reference) { return 100*std::abs(measured/reference - 1); }

}

ErrorMeasure::ErrorMeasure(const Dictionary& dict) : ofTable_(dict.found("table")), relative_(dict.lookupOr("relative", false))
{
    name_ = dict.lookup<std::string>(ofTable_ ? "table" : "comparison");
    quantity_ = dict.lookup<std::string>(ofTable_ ? "column" : "quantity");
    where_ = dict.where(ofTable_ ? "column" : "quantity");
    if (!ofTable_) return;
    file_ = dict.lookup<std::string>("file");
    reference_ = {entryText(dict, "reference"), dict.where("reference")};
}

MeasuredError ErrorMeasure::of(const RunOutcome& outcome) const
{
    if (!ofTable_)
    {
        const ComparedNumber row = ComparisonRows(outcome.path).require(name_, quantity_, where_);
        return {row.reference, row.measured, relative_ ? percent(row.measured, row.reference) : std::abs(row.deviation)};
    }
    const double reference = numberOf(reference_, outcome.values);
    const CsvTable table = readTable(outcome.path, name_, file_);
    if (!table.has(quantity_))
    {
        throw FatalInputError
        (
            where_, "Unknown measure: the table " + name_ + "/" + file_ + " has no column '" + quantity_ + "'",
            "one of its columns", table.columns(), quantity_
        );
    }
    if (table.rows() == 0) throw FatalInputError({outcome.path.string(), 0}, "The table " + file_ + " has no row");
    const double measured = table.number(table.rows() - 1, quantity_);
    return {reference, measured, relative_ ? percent(measured, reference) : std::abs(measured - reference)};
}

}
