// SPDX-License-Identifier: GPL-3.0-or-later
#include "ProfileReport.H"

#include "Ceilings.H"
#include "device/Device.H"
#include "device/ProfileTable.H"
#include "device/Reduce.H"

#include <iostream>

namespace shizuku
{

namespace
{

struct CountOf
{
    struct Sum
    {
        double value = 0;
        HOST_DEVICE void add(const Sum& other) { value += other.value; }
    };

    NeighbourView near;

    HOST_DEVICE Sum operator()(int i) const { return {double(near.count[i])}; }
};

double averageNeighbours(const Liquid& liquid, const Neighbourhood& near)
{
    Buffer<CountOf::Sum> scratch;
    return reduce(liquid.owned(), CountOf{near.view()}, scratch).value / liquid.owned();
}

}

void ProfileReport::count(int subSteps)
{
    if (!wanted_) return;
    if (passed_ >= warmUp)
    {
        counted_ += subSteps;
        return;
    }
    passed_ += subSteps;
    if (passed_ < warmUp) return;
    launchesBefore_ = deviceCounters().launches;
    startProfile();
}

void ProfileReport::report(const Liquid& liquid, const Neighbourhood& near) const
{
    if (!wanted_) return;
    if (counted_ == 0)
    {
        std::cout << "\nNo profile: it begins after " << warmUp << " sub-steps" << std::endl;
        return;
    }
    const auto times = stopProfile();
    const long launches = deviceCounters().launches - launchesBefore_;
    std::cout << "\nProfile of " << counted_ << " sub-steps, " << liquid.owned() << " particles with "
              << averageNeighbours(liquid, near) << " neighbours\n";
    printProfile(std::cout, times, launches, counted_, "sub-step");
    const Ceilings ceilings = measureCeilings();
    std::cout << "Ceilings: " << ceilings.bytesPerSecond << " bytes/s copied, " << ceilings.operationsPerSecond
              << " operations/s" << std::endl;
}

}
