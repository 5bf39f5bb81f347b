// SPDX-License-Identifier: GPL-3.0-or-later
// Ends the run when a condition on what other function objects measure is satisfied, as in OpenFOAM.
//
//     untilRest
//     {
//         type            runTimeControl;
//         conditions
//         {
//             rest
//             {
//                 type            minMax;
//                 functionObject  drop;                   // a liquidState, say
//                 fields          (rmsOverCapillary);     // columns of its table
//                 mode            minimum;                // minimum: they are below the value; maximum: above
//                 value           1e-3;
//                 duration        0.05;                   // s [0]: and have been so for as long
//             }
//         }
//     }
//
// Any one of several conditions ends the run. It makes one more step, which is written as stopAt writeNow does; endTime holds as
// ever. A condition looks at the row that was measured last, of several rows a time at the last one; what is not a number
// satisfies nothing. A run that was interrupted counts a duration on; one that ended by a condition and is started again goes on for it anew.

#include "functionObjects/FunctionObjects.H"

#include <algorithm>
#include <optional>
#include <sstream>

namespace shizuku
{

namespace
{

class Condition
{
public:
    explicit Condition(const Dictionary& dict)
    :
        dict_(dict), fields_(dict.lookup<std::vector<std::string>>("fields")),
        below_(dict.lookupChoice("mode", {"minimum", "maximum"}) == "minimum"), value_(dict.lookup<double>("value")),
        duration_(dict.found("duration") ? dict.lookupPositive("duration", dimensions::time, true) : 0)
    {
        dict.lookup<std::string>("functionObject");         // read again when all are made
        if (fields_.empty()) throw FatalInputError(dict.where("fields"), "There is no field", "one at least");
    }

    void connect(const FunctionObjects& all)
    {
        table_ = &all.tableOf(dict_, "functionObject");
        const std::vector<std::string>& names = table_->columns();
        for (const std::string& field : fields_)
        {
            const auto found = std::find(names.begin(), names.end(), field);
            if (found == names.end())
            {
                throw FatalInputError
                (
                    dict_.where("fields"), "There is no field '" + field + "' in " + table_->file().filename().string(),
                    "one of", names, field
                );
            }
            columns_.push_back(found - names.begin());
        }
    }

    bool satisfied(double time)
    {
        if (!holds()) since_.reset();
        else if (!since_) since_ = time;
        return isOver(time);
    }

    // What the condition is, whether it holds, and since when it has.
    std::vector<double> state() const
    {
        std::vector<double> state = itself();
        state.push_back(holds());
        if (since_) state.push_back(*since_);
        return state;
    }

    // Of another condition nothing counts.
    bool goOn(const std::vector<double>& state, double time)
    {
        const std::vector<double> same = itself();
        if (state.size() <= same.size() || !std::equal(same.begin(), same.end(), state.begin())) return false;
        held_ = state[same.size()] != 0;
        if (state.size() > same.size() + 1) since_ = state.back();
        return isOver(time);
    }

    std::string text() const
    {
        std::ostringstream text;
        for (const std::string& field : fields_) text << (&field == &fields_.front() ? "" : ", ") << field;
        text << (below_ ? " below " : " above ") << value_;
        if (duration_ > 0) text << " for " << duration_ << " s";
        return text.str();
    }

private:
    // For the row that was measured last; until this run has measured one, for that of the run that it continues.
    bool holds() const
    {
        const std::vector<CsvFile::Cell>& row = table_->lastRow();
        if (row.empty()) return held_;
        return std::all_of(columns_.begin(), columns_.end(), [&](std::size_t column)
        {
            const double* const number = std::get_if<double>(&row[column]);
            return number && (below_ ? *number < value_ : *number > value_);
        });
    }

    std::vector<double> itself() const
    {
        std::vector<double> numbers{double(below_), value_, duration_, double(columns_.size())};
        numbers.insert(numbers.end(), columns_.begin(), columns_.end());
        return numbers;
    }

    bool isOver(double time) const { return since_ && time - *since_ >= (1 - 1e-9) * duration_; }

    Dictionary dict_;
    std::vector<std::string> fields_;
    bool below_;
    double value_, duration_;
    const CsvFile* table_ = nullptr;
    std::vector<std::size_t> columns_;
    std::optional<double> since_;           // s
    bool held_ = false;
};

class RunTimeControl : public FunctionObject
{
public:
    RunTimeControl(const Dictionary& dict, const FunctionSetting&)
    {
        const Dictionary conditions = dict.subDict("conditions");
        for (const std::string& name : conditions.dictKeys())
        {
            const Dictionary each = conditions.subDict(name);
            each.lookupChoice("type", {"minMax"});
            conditions_.emplace_back(name, each);
        }
        if (conditions_.empty()) throw FatalInputError(conditions.where(), "There is no condition", "rest { type minMax; ... }");
    }

    void connect(const FunctionObjects& all) override
    {
        for (auto& [name, condition] : conditions_) condition.connect(all);
    }

    void execute(FlowView& flow) override
    {
        reason_.clear();
        for (auto& [name, condition] : conditions_)
        {
            if (condition.satisfied(flow.time.value())) reason_ = condition.text();
        }
        noteWhen(flow.time.value());
    }

    // Of a run that ends by a condition nothing.
    KeptNumbers state(double time) const override
    {
        KeptNumbers state;
        if (asked_ && *asked_ < time) return state;
        for (const auto& [name, condition] : conditions_) state[name] = condition.state();
        return state;
    }

    void goOn(const KeptNumbers& state, double time) override
    {
        for (auto& [name, condition] : conditions_)
        {
            const auto found = state.find(name);
            if (found != state.end() && condition.goOn(found->second, time)) reason_ = condition.text();
        }
        noteWhen(time);
    }

    bool looksAtDensities() const override { return false; }
    std::string needsOfRun() const override { return "its end, which it asks for"; }
    bool looksAtParticles() const override { return false; }
    std::string reasonToEnd() const override { return reason_; }

private:
    void noteWhen(double time)
    {
        if (reason_.empty()) asked_.reset();
        else if (!asked_) asked_ = time;
    }

    std::vector<std::pair<std::string, Condition>> conditions_;     // with their names
    std::string reason_;
    std::optional<double> asked_;           // s, when the end was first asked for
};

const FunctionObjectTable::Add<RunTimeControl> registered{"runTimeControl", "ends the run when a condition is satisfied"};

}

}
