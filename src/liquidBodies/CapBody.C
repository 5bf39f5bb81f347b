// SPDX-License-Identifier: GPL-3.0-or-later
// type cap; centre (0 0 0); normal (0 0 1); contactAngle 60; volume 4.19e-9;
// A spherical cap on a plane wall: the shape of a small drop at rest. The centre is that of the base circle, the normal
// that of the wall, into the liquid; the contact angle is in degrees, inside the liquid.

#include "caseFiles/UnitVector.H"
#include "core/angles/Degrees.H"
#include "liquidBodies/LiquidBody.H"

#include <numbers>

namespace shizuku
{

class CapBody : public LiquidShape<CapBody>
{
public:
    CapBody(const Dictionary& dict, const std::filesystem::path&)
    :
        base_(dict.lookupDimensionedVector("centre", dimensions::length)),
        normal_(readUnitVector(dict, "normal")),
        volume_(dict.lookupPositive("volume", dimensions::volume))
    {
        const double degrees = dict.lookup<double>("contactAngle");
        if (!(degrees > 0 && degrees <= 180))
        {
            throw FatalInputError
            (
                dict.where("contactAngle"), "The contact angle of " + dict.name() + " is " + std::to_string(degrees),
                "degrees above 0 and up to 180"
            );
        }
        // The volume of a cap of a sphere of radius R is pi/3 R^3 (2 + cos)(1 - cos)^2.
        cosine_ = std::cos(radians(degrees));
        radius_ = std::cbrt(3*volume_/(std::numbers::pi*(2 + cosine_)*(1 - cosine_)*(1 - cosine_)));
    }

    BodyFrame frame() const override { return BodyFrame::along(base_, normal_); }
    Vector3 low() const override { return {-radius_, -radius_, 0}; }
    Vector3 high() const override { return {radius_, radius_, radius_*(1 - cosine_)}; }
    double volume() const override { return volume_; }

    bool contains(const Vector3& x) const override
    {
        const Vector3 centre = base_ - radius_*cosine_*normal_;
        return dot(x - base_, normal_) >= 0 && squaredLength(x - centre) <= radius_*radius_;
    }

private:
    Vector3 base_, normal_;
    double volume_;
    double cosine_ = 0, radius_ = 0;    // of the contact angle; of the sphere, m
};

static const LiquidBodyTable::Add<CapBody> registered{"cap"};

}
