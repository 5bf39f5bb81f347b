// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/viscosity/Viscosity.H"

namespace shizuku
{

std::unique_ptr<Viscosity> Viscosity::New(const Dictionary& models, Liquid& liquid)
{
    const auto word = models.lookup<std::string>("viscosity");
    return ViscosityTable::New
    (
        "viscosity", word, models.where("viscosity"), models.subDictOrEmpty(word + "Coeffs"), liquid
    );
}

}
