// SPDX-License-Identifier: GPL-3.0-or-later
// type angularOscillation; origin (0 0 0); axis (0 0 1); amplitude 45; frequency 1; phase -90;
// To and fro about an axis, by the amplitude [degrees] to either side of the middle.

#include "wallMotions/HarmonicPhase.H"

namespace shizuku
{

class AngularOscillationMotion : public TurningMotion
{
public:
    explicit AngularOscillationMotion(const Dictionary& dict) : TurningMotion(dict), amplitude_(radians(dict.lookup<double>("amplitude"))), harmonic_(dict) {}

protected:
    double angle(double t) const override { return amplitude_*harmonic_(t); }

private:
    double amplitude_;
    HarmonicPhase harmonic_;
};

static const WallMotionTable::Add<AngularOscillationMotion> registered{"angularOscillation", "harmonic, about an axis"};

}
