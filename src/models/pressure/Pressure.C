// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/pressure/Pressure.H"

namespace shizuku
{

std::unique_ptr<Pressure> Pressure::New
(
    const Dictionary& models, const Dictionary& solution, Liquid& liquid, const Walls& walls, FreeSurface& surface
)
{
    return PressureTable::New
    (
        "pressure", models.lookup<std::string>("pressure"), models.where("pressure"),
        solution.subDictOrEmpty("pressure"), liquid, walls, surface
    );
}

}
