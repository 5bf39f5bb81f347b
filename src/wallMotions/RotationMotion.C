// SPDX-License-Identifier: GPL-3.0-or-later
// type rotation; origin (0 0 0); axis (0 0 1); omega 6.28;
// At a constant rate [rad/s], anticlockwise where the axis points at the viewer.

#include "wallMotions/WallMotion.H"

namespace shizuku
{

class RotationMotion : public TurningMotion
{
public:
    explicit RotationMotion(const Dictionary& dict) : TurningMotion(dict), omega_(dict.lookupDimensioned("omega", perTime)) {}

protected:
    double angle(double t) const override { return omega_*t; }

private:
    double omega_;
};

static const WallMotionTable::Add<RotationMotion> registered{"rotation", "a constant rate about an axis"};

}
