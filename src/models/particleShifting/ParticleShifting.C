// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/particleShifting/ParticleShifting.H"

namespace shizuku
{

std::unique_ptr<ParticleShifting> ParticleShifting::New(const Dictionary& models, Liquid& liquid, const Walls& walls, FreeSurface& surface)
{
    const auto word = models.lookupOr<std::string>("particleShifting", "none");
    return ParticleShiftingTable::New
    (
        "particleShifting", word, models.where("particleShifting"), models.subDictOrEmpty(word + "Coeffs"), liquid, walls, surface
    );
}

}
