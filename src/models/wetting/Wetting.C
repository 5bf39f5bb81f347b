// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/wetting/Wetting.H"

namespace shizuku
{

std::unique_ptr<Wetting> Wetting::New
(
    const Dictionary& models, Liquid& liquid, const Walls& walls, const SurfaceTension& tension
)
{
    const auto word = models.lookup<std::string>("wetting");
    return WettingTable::New
    (
        "wetting", word, models.where("wetting"), models.subDictOrEmpty(word + "Coeffs"), liquid, walls, tension
    );
}

PairCoefficients requirePairCoefficients(const SurfaceTension& tension, const Dictionary& coeffs)
{
    const auto coefficients = tension.pairCoefficients();
    if (!coefficients)
    {
        throw FatalInputError
        (
            coeffs.where(), "The wetting model continues a pair force at the walls, and the surface tension has none",
            "surfaceTension Akinci2013 or Fujisawa2014, or wetting none"
        );
    }
    return *coefficients;
}

}
