// SPDX-License-Identifier: GPL-3.0-or-later
// type ellipsoid; centre (0 0 0); semiAxes (1e-3 1e-3 1.1e-3);
// Semi-axes along x, y and z: a drop that is to swing about its sphere.

#include "liquidBodies/LiquidBody.H"

#include <numbers>

namespace shizuku
{

class EllipsoidBody : public LiquidShape<EllipsoidBody>
{
public:
    EllipsoidBody(const Dictionary& dict, const std::filesystem::path&)
    : centre_(dict.lookupDimensionedVector("centre", dimensions::length)),
      axes_(dict.lookupDimensionedVector("semiAxes", dimensions::length))
    {
        if (axes_.x > 0 && axes_.y > 0 && axes_.z > 0) return;
        throw FatalInputError(dict.where("semiAxes"), "The semi-axes of " + dict.name() + " are not all positive", "(a b c)");
    }

    BodyFrame frame() const override { return {centre_}; }
    Vector3 low() const override { return -1*axes_; }
    Vector3 high() const override { return axes_; }
    double volume() const override { return 4*std::numbers::pi/3*axes_.x*axes_.y*axes_.z; }

    bool contains(const Vector3& x) const override
    {
        const Vector3 r = x - centre_;
        return squaredLength({r.x/axes_.x, r.y/axes_.y, r.z/axes_.z}) <= 1;
    }

private:
    Vector3 centre_, axes_;
};

static const LiquidBodyTable::Add<EllipsoidBody> registered{"ellipsoid"};

}
