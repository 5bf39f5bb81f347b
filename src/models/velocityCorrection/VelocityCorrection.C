// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/velocityCorrection/VelocityCorrection.H"

namespace shizuku
{

std::unique_ptr<VelocityCorrection> VelocityCorrection::New(const Dictionary& models, Liquid& liquid)
{
    const auto word = models.lookupOr<std::string>("velocityCorrection", "none");
    return VelocityCorrectionTable::New
    (
        "velocityCorrection", word, models.where("velocityCorrection"), models.subDictOrEmpty(word + "Coeffs"), liquid
    );
}

}
