// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the results of a case with what theory or experiment say they should be.

#include "Comparison.H"

#include "core/arguments/runApplication.H"
#include "core/fieldFile/CsvFile.H"
#include "core/messages/Error.H"

#include <iomanip>
#include <cmath>
#include <iostream>

using namespace shizuku;

namespace
{

const ApplicationInfo info
{
    "compareReference",
    "Compare a case with reference solutions (system/compareReferenceDict to postProcessing/compareReference).",
    {}
};

std::string verdict(const ComparisonRow& row)
{
    return !row.judged() ? "-" : row.passed() ? "pass" : "miss";
}

void print(const std::string& name, const ComparisonRow& row)
{
    std::cout << std::left << std::setw(14) << name << std::setw(32) << row.quantity << std::right << std::setw(13)
              << row.measured << (row.unit.empty() ? "" : " ") << row.unit;
    if (!std::isnan(row.reference)) std::cout << ", reference " << row.reference << ", deviation " << row.deviation << ' ' << row.deviationUnit;
    if (row.judged()) std::cout << ", at most " << row.target << ": " << verdict(row);
    std::cout << '\n';
}

void compareReference(const Arguments& args)
{
    const Dictionary dict = Dictionary::read(args.casePath()/"system/compareReferenceDict");
    const Dictionary comparisons = dict.subDict("comparisons");
    std::vector<std::pair<std::string, std::unique_ptr<Comparison>>> wanted;
    for (const std::string& name : comparisons.dictKeys())
    {
        const Dictionary each = comparisons.subDict(name);
        wanted.emplace_back
        (
            name, ComparisonTable::New("comparison", each.lookup<std::string>("type"), each.where("type"), each)
        );
    }
    if (wanted.empty()) throw FatalInputError(comparisons.where(), "There is no comparison", "angle { type contactAngle; ... }");
    dict.refuseUnused();

    const CaseResults results(args.casePath());
    CsvFile table
    (
        args.casePath()/"postProcessing/compareReference/comparison.csv",
        {
            {"comparison", ""}, {"quantity", ""}, {"unit", ""}, {"reference", ""}, {"measured", ""}, {"deviation", ""},
            {"deviationUnit", ""}, {"target", ""}, {"verdict", ""}
        }
    );
    for (const auto& [name, comparison] : wanted)
    {
        for (const ComparisonRow& row : comparison->compare(results))
        {
            print(name, row);
            table.addRow
            ({
                name, row.quantity, row.unit, row.reference, row.measured, row.deviation, row.deviationUnit, row.target,
                verdict(row)
            });
        }
    }
    table.write();
    std::cout << "\nWritten: " << table.file().string() << '\n';
}

}

int main(int argc, char** argv)
{
    return runApplication(argc, argv, info, compareReference);
}
