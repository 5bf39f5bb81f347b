// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseWriter.H"

namespace shizuku
{

void CaseWriter::write(Time& time, FlowView& flow, const CaseChanges& changes, FunctionObjects& functions)
{
    if (!writes_)
    {
        if (time.writeDue()) time.writing({});
        return;
    }
    WriteJob state;
    if (time.writeDue())
    {
        const Liquid& liquid = flow.liquid();
        const auto particles = particles_.copy(liquid, liquid.units(), time.format());
        const auto theta = changes.writingTheta(time.format());
        const auto measured = functions.writingState(time);
        state = time.writing([=](const std::filesystem::path& folder)
        {
            particles(folder);
            theta(folder);
            measured(folder);
        });
    }
    functions.write(time, background_);                 // before the time that they lead up to can be seen
    if (state) background_.add(std::move(state));
    background_.start();
}

}
