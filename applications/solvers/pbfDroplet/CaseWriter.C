// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseWriter.H"

#include "core/messages/Error.H"
#include "parallel/AllParts.H"

#include <exception>
#include <system_error>

namespace shizuku
{

CaseWriter::~CaseWriter()
{
    if (!shared_) return;
    try
    {
        background_.finish();
    }
    catch (const std::exception& error)
    {
        warning(error.what());          // another error is on its way
    }
    std::error_code ignored;
    if (parts_.part() == 0) std::filesystem::remove_all(shared_->folder, ignored);
}

void CaseWriter::write(Time& time, FlowView& flow, const CaseChanges& changes, FunctionObjects& functions)
{
    endShared(time.writeDue());
    WriteJob state;
    if (time.writeDue()) state = parts_.parts() > 1 ? writingShare(time, flow, changes, functions) : writingTime(time, flow, changes, functions);
    if (parts_.part() == 0) functions.write(time, background_);         // before the time that they lead up to can be seen
    if (state) background_.add(std::move(state));
    background_.start();
}

void CaseWriter::finish()
{
    endShared(true);
    inAllParts(parts_, [&] { background_.finish(); });
}

WriteJob CaseWriter::writingTime(Time& time, FlowView& flow, const CaseChanges& changes, const FunctionObjects& functions)
{
    const Liquid& liquid = flow.liquid();
    const auto particles = particles_.copy(liquid, liquid.units(), time.format());
    const auto theta = changes.writingTheta(time.format());
    const auto measured = functions.writingState(time);
    return time.writing([=](const std::filesystem::path& folder)
    {
        particles(folder);
        theta(folder);
        measured(folder);
    });
}

WriteJob CaseWriter::writingShare(Time& time, FlowView& flow, const CaseChanges& changes, const FunctionObjects& functions)
{
    shared_ = time.sharedWriting();
    const std::filesystem::path folder = shared_->folder;
    const Liquid& liquid = flow.part();
    inAllParts(parts_, [&]
    {
        if (parts_.part() > 0) return;
        shared_->begin();
        std::filesystem::create_directory(folder / liquid.name());
    });
    const FileOrder order(parts_, flow.near.keysOfWhole(), liquid.id, liquid.owned());
    const auto particles = particles_.copyShare(liquid, liquid.units(), order, time.format(), folder);
    if (parts_.part() > 0) return particles;
    const auto theta = changes.writingTheta(time.format());
    const auto measured = functions.writingState(time);
    return [=]
    {
        particles();
        theta(folder);
        measured(folder);
    };
}

// Gives the folder its name where all parts have written their shares, or waits until they have.
void CaseWriter::endShared(bool waits)
{
    if (!shared_ || (!waits && parts_.any(!background_.isIdle()))) return;
    inAllParts(parts_, [&] { background_.finish(); });
    if (parts_.part() == 0)
    {
        background_.add(shared_->end);
        background_.start();
    }
    shared_.reset();
}

}
