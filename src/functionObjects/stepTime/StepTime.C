// SPDX-License-Identifier: GPL-3.0-or-later
// Wall-clock time of each step, without what is written between steps.
//
//     timing { type stepTime; }
//
// The simulated time and the milliseconds since the row before, without those of the tables that were written with it: to
// be had each step and written with the fields, as is the default. The first step, which loads code and allocates memory,
// has a row like any other: benchmarks leave it out as warm-up. What is read and checked before it is no step.

#include "core/fieldFile/CsvFile.H"
#include "functionObjects/FunctionObject.H"

#include <chrono>

namespace shizuku
{

namespace
{

class StepTime : public FunctionObject
{
public:
    StepTime(const Dictionary&, const FunctionSetting& setting)
    :
        table_(setting.folder / "stepTime.csv", {{"time", "s"}, {"wall", "ms"}})
    {}

    // Not what was read and checked before.
    void modelsMade(FlowView&) override
    {
        if (begun_) return;
        begun_ = true;
        last_ = Clock::now();
    }

    // The speeds were read off the device: the step is complete.
    void execute(FlowView& flow) override
    {
        const auto now = Clock::now();
        table_.addRow({flow.time.value(), std::chrono::duration<double, std::milli>(now - last_).count()});
        last_ = Clock::now();
    }

    bool looksAtDensities() const override { return false; }
    std::string needsOfRun() const override { return "the time that its steps take"; }
    bool looksAtParticles() const override { return false; }
    const CsvFile* table() const override { return &table_; }

    WriteJob writing() override
    {
        WriteJob job = FunctionObject::writing();
        last_ = Clock::now();
        return job;
    }

private:
    using Clock = std::chrono::steady_clock;

    CsvFile table_;
    Clock::time_point last_;
    bool begun_ = false;
};

const FunctionObjectTable::Add<StepTime> registered{"stepTime", "wall-clock time of each step"};

}

}
