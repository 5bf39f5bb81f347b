// SPDX-License-Identifier: GPL-3.0-or-later
// type sphere; centre (0 0 0.001); radius 1e-3; latticeAxis (1 1 1);
//
// latticeAxis: where the lattice's z points, (0 0 1) by default. A drop that hits a level wall with rows of particles along x and y spreads as a square; with
// a turned lattice, as by (1 1 1), it spreads as a disc.

#include "caseFiles/UnitVector.H"
#include "liquidBodies/LiquidBody.H"

#include <numbers>

namespace shizuku
{

class SphereBody : public LiquidShape<SphereBody>
{
public:
    SphereBody(const Dictionary& dict, const std::filesystem::path&)
    :
        centre_(dict.lookupDimensionedVector("centre", dimensions::length)),
        radius_(dict.lookupPositive("radius", dimensions::length)),
        frame_(dict.found("latticeAxis") ? BodyFrame::along(centre_, readUnitVector(dict, "latticeAxis")) : BodyFrame{centre_})
    {}

    BodyFrame frame() const override { return frame_; }
    Vector3 low() const override { return {-radius_, -radius_, -radius_}; }
    Vector3 high() const override { return {radius_, radius_, radius_}; }
    bool contains(const Vector3& x) const override { return squaredLength(x - centre_) <= radius_*radius_; }
    double volume() const override { return 4*std::numbers::pi/3*radius_*radius_*radius_; }

private:
    Vector3 centre_;
    double radius_;
    BodyFrame frame_;
};

static const LiquidBodyTable::Add<SphereBody> registered{"sphere"};

}
