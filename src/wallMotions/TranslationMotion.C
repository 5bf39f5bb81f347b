// SPDX-License-Identifier: GPL-3.0-or-later
// type translation; velocity (0.1 0 0);
// At a constant velocity [m/s] from start on.

#include "wallMotions/WallMotion.H"

namespace shizuku
{

class TranslationMotion : public WallMotion
{
public:
    explicit TranslationMotion(const Dictionary& dict) : WallMotion(dict), velocity_(dict.lookupDimensionedVector("velocity", dimensions::velocity)) {}

protected:
    Pose after(double t) const override { return Pose::translation(t*velocity_); }

private:
    Vector3 velocity_;
};

static const WallMotionTable::Add<TranslationMotion> registered{"translation", "a constant velocity"};

}
