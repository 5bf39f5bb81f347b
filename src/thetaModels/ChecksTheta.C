// SPDX-License-Identifier: GPL-3.0-or-later
// type checks; theta (30 110);
// rows    { direction (0 1 0); period 1e-3; }      // see StripePattern.H: duty and phase too
// columns { direction (1 0 0); period 1e-3; }
// Two sets of stripes that cross: the first angle [degrees] where both or neither of them are, else the second one.

#include "thetaModels/StripePattern.H"
#include "thetaModels/ThetaModel.H"

namespace shizuku
{

class ChecksTheta : public ThetaModel
{
public:
    ChecksTheta(const Dictionary& dict, const std::filesystem::path&)
    :
        rows_(dict.subDict("rows")), columns_(dict.subDict("columns")), theta_(readThetaPair(dict, "theta"))
    {}

    double theta(const Vector3& x) const override { return rows_(x) == columns_(x) ? theta_.first : theta_.second; }

private:
    StripePattern rows_, columns_;
    std::pair<double, double> theta_;
};

static const ThetaModelTable::Add<ChecksTheta> registered{"checks"};

}
