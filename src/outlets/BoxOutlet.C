// SPDX-License-Identifier: GPL-3.0-or-later
// type box; min (0 0 0); max (0.01 0.01 0.01);         // what comes into it is taken out
// type outside; min (0 0 0); max (0.1 0.1 0.1);        // what leaves it is

#include "outlets/Outlet.H"

namespace shizuku
{

namespace
{

template<bool outside>
class BoxOutlet : public Outlet
{
public:
    explicit BoxOutlet(const Dictionary& dict)
    :
        min_(dict.lookupDimensionedVector("min", dimensions::length)), max_(dict.lookupDimensionedVector("max", dimensions::length))
    {
        if (min_.x < max_.x && min_.y < max_.y && min_.z < max_.z) return;
        throw FatalInputError
        (
            dict.where("max"), "The box of " + dict.name() + " has min " + str(min_) + " and max " + str(max_), "every component of min below that of max"
        );
    }

    OutletRegion region() const override
    {
        OutletRegion region(outside);
        region.addBox(min_, max_);
        return region;
    }

private:
    Vector3 min_, max_;
};

const OutletTable::Add<BoxOutlet<false>> registeredBox{"box", "takes out what comes into a box"};
const OutletTable::Add<BoxOutlet<true>> registeredOutside{"outside", "takes out what leaves a box"};

}

}
