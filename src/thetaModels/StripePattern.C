// SPDX-License-Identifier: GPL-3.0-or-later
#include "thetaModels/StripePattern.H"

#include "caseFiles/UnitVector.H"

namespace shizuku
{

StripePattern::StripePattern(const Dictionary& dict)
:
    direction_(readUnitVector(dict, "direction")),
    period_(dict.lookupPositive("period", dimensions::length)),
    duty_(dict.lookupOr("duty", 0.5)),
    phase_(dict.lookupOr("phase", 0.0))
{
    if (!(duty_ >= 0 && duty_ <= 1))
    {
        throw FatalInputError
        (
            dict.where("duty"), "The duty of " + dict.name() + " is " + std::to_string(duty_),
            "the share of a period that the stripe takes, 0 to 1"
        );
    }
}

}
