// SPDX-License-Identifier: GPL-3.0-or-later
// law dynamic; theta0 90; thetaAdv 110; thetaRec 70; uTheta 1;
// The angle goes from theta0 at rest to thetaAdv of a fast line that advances, and to thetaRec of one that recedes [degrees]:
//
//     theta = theta0 + (thetaAdv - theta0) tanh(u/uTheta),  u >= 0;       theta0 + (theta0 - thetaRec) tanh(u/uTheta),  u < 0
//
// uTheta [m/s]. OpenFOAM's dynamicAlphaContactAngle has thetaAdv - thetaRec on both sides, so that its limits are not these angles.

#include "thetaModels/ContactAngleLaw.H"

#include <cmath>

namespace shizuku
{

class DynamicLaw : public HeldLaw
{
public:
    DynamicLaw(const Dictionary& dict, const std::filesystem::path& casePath)
    :
        HeldLaw(dict, casePath, Takes::bothAndTheta0), uTheta_(dict.lookupPositive("uTheta", dimensions::velocity))
    {}

    Limits limits(const LineAngles& angles, double speed, const LineScales&) const override
    {
        const double part = std::tanh(speed/uTheta_);
        if (speed >= 0) return {angles.theta, angles.theta + (angles.advancing - angles.theta)*part};
        return {angles.theta + (angles.theta - angles.receding)*part, angles.theta};
    }

    double typicalSpeed(const LineScales&) const override { return uTheta_; }

private:
    double uTheta_;
};

static const ContactAngleLawTable::Add<DynamicLaw> registered{"dynamic"};

}
