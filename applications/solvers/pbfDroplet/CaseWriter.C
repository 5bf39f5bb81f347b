#include "CaseWriter.H"

namespace shizuku
{

void CaseWriter::write(Time& time, FlowView& flow, const CaseChanges& changes, FunctionObjects& functions)
{
    if (time.writeDue())
    {
        flow.models.pressure->complete();
        const Liquid& liquid = flow.liquid();
        const auto particles = particles_.copy(liquid, liquid.units(), time.format());
        const auto theta = changes.writingTheta(time.format());
        background_.add(time.writing([=](const std::filesystem::path& folder)
        {
            particles(folder);
            theta(folder);
        }));
    }
    functions.write(time, background_);
    background_.start();
}

}
