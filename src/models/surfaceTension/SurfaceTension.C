// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/surfaceTension/SurfaceTension.H"

namespace shizuku
{

std::unique_ptr<SurfaceTension> SurfaceTension::New
(
    const Dictionary& models, Liquid& liquid, const Walls& walls, FreeSurface& surface
)
{
    const auto word = models.lookup<std::string>("surfaceTension");
    return SurfaceTensionTable::New
    (
        "surfaceTension", word, models.where("surfaceTension"), models.subDictOrEmpty(word + "Coeffs"), liquid, walls,
        surface
    );
}

}
