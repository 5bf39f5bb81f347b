// SPDX-License-Identifier: GPL-3.0-or-later
// law hysteresis; thetaAdv 100; thetaRec 60;
// The line is held while its angle is between both; it advances at thetaAdv and recedes at thetaRec [degrees], at any speed.

#include "thetaModels/ContactAngleLaw.H"

namespace shizuku
{

class HysteresisLaw : public HeldLaw
{
public:
    HysteresisLaw(const Dictionary& dict, const std::filesystem::path& casePath) : HeldLaw(dict, casePath, Takes::both) {}

    Limits limits(const LineAngles& angles, double, const LineScales&) const override { return {angles.receding, angles.advancing}; }
};

static const ContactAngleLawTable::Add<HysteresisLaw> registered{"hysteresis"};

}
