// SPDX-License-Identifier: GPL-3.0-or-later
// type constant; theta 60;     // degrees, the same everywhere on the patch

#include "thetaModels/ThetaModel.H"

namespace shizuku
{

class ConstantTheta : public ThetaModel
{
public:
    ConstantTheta(const Dictionary& dict, const std::filesystem::path&) : theta_(readTheta(dict, "theta")) {}

    double theta(const Vector3&) const override { return theta_; }

private:
    double theta_;
};

static const ThetaModelTable::Add<ConstantTheta> registered{"constant"};

}
