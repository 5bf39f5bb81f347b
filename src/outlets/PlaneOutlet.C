// SPDX-License-Identifier: GPL-3.0-or-later
// type plane; point (0 0 -0.01); normal (0 0 -1);      // from the scene to what is taken out

#include "caseFiles/UnitVector.H"
#include "outlets/Outlet.H"

namespace shizuku
{

class PlaneOutlet : public Outlet
{
public:
    explicit PlaneOutlet(const Dictionary& dict)
    :
        point_(dict.lookupDimensionedVector("point", dimensions::length)), normal_(readUnitVector(dict, "normal"))
    {}

    OutletRegion region() const override
    {
        OutletRegion region;
        region.addPlane(point_, normal_);
        return region;
    }

private:
    Vector3 point_, normal_;
};

static const OutletTable::Add<PlaneOutlet> registered{"plane", "takes out what is beyond a plane"};

}
