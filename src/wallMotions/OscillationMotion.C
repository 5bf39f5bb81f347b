// SPDX-License-Identifier: GPL-3.0-or-later
// type oscillation; amplitude (0 0 1e-4); frequency 50; phase 0;
// To and fro by the amplitude [m] to either side of the middle.

#include "wallMotions/HarmonicPhase.H"

namespace shizuku
{

class OscillationMotion : public WallMotion
{
public:
    explicit OscillationMotion(const Dictionary& dict)
    :
        WallMotion(dict), amplitude_(dict.lookupDimensionedVector("amplitude", dimensions::length)), harmonic_(dict)
    {}

protected:
    Pose after(double t) const override { return Pose::translation(harmonic_(t)*amplitude_); }

private:
    Vector3 amplitude_;
    HarmonicPhase harmonic_;
};

static const WallMotionTable::Add<OscillationMotion> registered{"oscillation", "harmonic, along a line"};

}
