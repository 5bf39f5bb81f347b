// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/bodyForce/BodyForce.H"

namespace shizuku
{

std::unique_ptr<BodyForce> BodyForce::New
(
    const Dictionary& models, const std::filesystem::path& constant, const Liquid& liquid
)
{
    return BodyForceTable::New
    (
        "bodyForce", models.lookup<std::string>("bodyForce"), models.where("bodyForce"), constant, liquid
    );
}

}
