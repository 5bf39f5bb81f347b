// SPDX-License-Identifier: GPL-3.0-or-later
// Velocities stay what the step has made them.

#include "models/velocityFilter/VelocityFilter.H"

namespace shizuku
{

namespace
{

class NoFilter : public VelocityFilter
{
public:
    NoFilter(const Dictionary&, Liquid&) {}
    void apply(Liquid&, const Neighbourhood&, const Walls&, scalar) override {}
};

const VelocityFilterTable::Add<NoFilter> registered{"none", "velocities stay what the step has made them"};

}

}
