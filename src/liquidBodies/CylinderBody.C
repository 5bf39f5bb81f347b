// SPDX-License-Identifier: GPL-3.0-or-later
// type cylinder; point (0 0 0); axis (0 0 1); radius 1e-3; height 2e-3;
// The point is the middle of the base, from which the cylinder extends along the axis.

#include "caseFiles/UnitVector.H"
#include "liquidBodies/LiquidBody.H"

#include <numbers>

namespace shizuku
{

class CylinderBody : public LiquidShape<CylinderBody>
{
public:
    CylinderBody(const Dictionary& dict, const std::filesystem::path&)
    :
        point_(dict.lookupDimensionedVector("point", dimensions::length)),
        axis_(readUnitVector(dict, "axis")),
        radius_(dict.lookupPositive("radius", dimensions::length)),
        height_(dict.lookupPositive("height", dimensions::length))
    {}

    BodyFrame frame() const override { return BodyFrame::along(point_, axis_); }
    Vector3 low() const override { return {-radius_, -radius_, 0}; }
    Vector3 high() const override { return {radius_, radius_, height_}; }
    double volume() const override { return std::numbers::pi*radius_*radius_*height_; }

    bool contains(const Vector3& x) const override
    {
        const double along = dot(x - point_, axis_);
        return along >= 0 && along <= height_ && squaredLength(x - point_ - along*axis_) <= radius_*radius_;
    }

private:
    Vector3 point_, axis_;
    double radius_, height_;
};

static const LiquidBodyTable::Add<CylinderBody> registered{"cylinder"};

}
