// SPDX-License-Identifier: GPL-3.0-or-later
// law coxVoinov; theta0 60; slipLength 1e-9;          // or thetaAdv and thetaRec instead of theta0
// The angle a spacing d from a line that moves at u, with that of the line itself, theta_m [degrees], and the slip length b [m]:
//
//     theta^3 = theta_m^3 + 9 Ca ln(d/b),      Ca = mu u/sigma           (Voinov 1976; Cox 1986)
//
// Ca has the sign of u: lines that recede have smaller angles, down to none. theta_m: theta0; or thetaAdv of a line that advances and thetaRec of one that
// recedes, which holds it in between.

#include "core/angles/Degrees.H"
#include "thetaModels/ContactAngleLaw.H"

#include <algorithm>
#include <cmath>

namespace shizuku
{

class CoxVoinovLaw : public HeldLaw
{
public:
    CoxVoinovLaw(const Dictionary& dict, const std::filesystem::path& casePath)
    :
        HeldLaw(dict, casePath, Takes::either), slip_(dict.found("slipLength") ? dict.lookupPositive("slipLength", dimensions::length) : usualSlip)
    {}

    Limits limits(const LineAngles& angles, double speed, const LineScales& scales) const override
    {
        if (speed >= 0) return {angles.receding, bent(angles.advancing, speed, scales)};
        return {bent(angles.receding, speed, scales), angles.advancing};
    }

    // Of which 9 Ca ln(d/b) is one radian cubed.
    double typicalSpeed(const LineScales& scales) const override
    {
        return scales.capillarySpeed()/std::max(9*decades(scales), 1.0);
    }

private:
    static constexpr double usualSlip = 1e-9;       // m, of a molecule or so

    double decades(const LineScales& scales) const { return std::max(std::log(scales.spacing/slip_), 0.0); }

    double bent(double theta, double speed, const LineScales& scales) const
    {
        const double cube = std::pow(radians(theta), 3) + 9*speed/scales.capillarySpeed()*decades(scales);
        return std::clamp(degrees(std::cbrt(std::max(cube, 0.0))), 0.0, 180.0);
    }

    double slip_;
};

static const ContactAngleLawTable::Add<CoxVoinovLaw> registered{"coxVoinov"};

}
