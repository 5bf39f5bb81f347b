// SPDX-License-Identifier: GPL-3.0-or-later
// type stripes; theta (30 110); direction (1 0 0); period 1e-3; duty 0.5; phase 0;
// The first angle [degrees] on the stripes, the second one between them; the rest: see StripePattern.H.

#include "thetaModels/StripePattern.H"
#include "thetaModels/ThetaModel.H"

namespace shizuku
{

class StripesTheta : public ThetaModel
{
public:
    StripesTheta(const Dictionary& dict, const std::filesystem::path&)
    :
        stripes_(dict), theta_(readThetaPair(dict, "theta"))
    {}

    double theta(const Vector3& x) const override { return stripes_(x) ? theta_.first : theta_.second; }

private:
    StripePattern stripes_;
    std::pair<double, double> theta_;
};

static const ThetaModelTable::Add<StripesTheta> registered{"stripes"};

}
