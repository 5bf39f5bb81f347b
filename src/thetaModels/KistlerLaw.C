// SPDX-License-Identifier: GPL-3.0-or-later
// law kistler; theta0 60;          // or thetaAdv and thetaRec instead of theta0
// Hoffman's function, as Kistler (1993) has it, of a line that moves at u:
//
//     theta = f(Ca + f^-1(theta_m)),  Ca = mu u/sigma,      f(x) = acos(1 - 2 tanh(5.16 (x/(1 + 1.31 x^0.99))^0.706))
//
// theta_m [degrees]: theta0; or thetaAdv of a line that advances and thetaRec of one that recedes, which holds it in between. f(x) = 0 of x < 0.

#include "core/angles/Degrees.H"
#include "thetaModels/ContactAngleLaw.H"

#include <cmath>

namespace shizuku
{

class KistlerLaw : public HeldLaw
{
public:
    KistlerLaw(const Dictionary& dict, const std::filesystem::path& casePath) : HeldLaw(dict, casePath, Takes::either) {}

    Limits limits(const LineAngles& angles, double speed, const LineScales& scales) const override
    {
        const double Ca = speed/scales.capillarySpeed();
        if (speed >= 0) return {angles.receding, hoffman(Ca + inverse(angles.advancing))};
        return {hoffman(Ca + inverse(angles.receding)), angles.advancing};
    }

    // Hoffman's angle of 57 degrees has a Ca of 0.01.
    double typicalSpeed(const LineScales& scales) const override { return 0.01*scales.capillarySpeed(); }

private:
    static constexpr double most = 10;      // x of 180 degrees, but for 1e-3 of one

    static double hoffman(double x)
    {
        if (!(x > 0)) return 0;
        return degrees(std::acos(1 - 2*std::tanh(5.16*std::pow(x/(1 + 1.31*std::pow(x, 0.99)), 0.706))));
    }

    static double inverse(double theta)
    {
        double low = 0, high = most;
        for (int halving = 0; halving < 60; ++halving)
        {
            const double x = 0.5*(low + high);
            (hoffman(x) < theta ? low : high) = x;
        }
        return 0.5*(low + high);
    }
};

static const ContactAngleLawTable::Add<KistlerLaw> registered{"kistler"};

}
