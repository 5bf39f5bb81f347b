// SPDX-License-Identifier: GPL-3.0-or-later
// How far the liquid's centroid has moved since the first step of the run. (What is measured, and from which source.)
//
//     drift { type @word@; }
//
// A row a step in postProcessing/drift/<start time>/@word@.csv.

#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"

#include <array>
#include <cmath>
#include <optional>

namespace shizuku
{

namespace
{

class @class@ : public FunctionObject
{
public:
    @class@(const Dictionary&, const FunctionSetting& setting)
    :
        table_(setting.folder / "@word@.csv", {{"time", "s"}, {"distance", "m"}})
    {}

    void execute(FlowView& flow) override
    {
        const auto& b = flow.state().centroid;
        if (!first_) first_ = b;
        const auto& a = *first_;
        table_.addRow({flow.time.value(), std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2])});
    }

    const CsvFile* table() const override { return &table_; }

private:
    std::optional<std::array<double, 3>> first_;        // m
    CsvFile table_;
};

const FunctionObjectTable::Add<@class@> registered{"@word@", "what it does, in a line"};

}

}
