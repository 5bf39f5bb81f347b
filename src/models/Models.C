// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/Models.H"

#include <algorithm>

namespace shizuku
{

namespace
{

// A case may keep the coefficients of models that it does not use at present.
void toleratePassiveCoefficients(const Dictionary& models)
{
    std::vector<std::string> known;
    for (const auto& words : {SurfaceTensionTable::words(), WettingTable::words(), VelocityCorrectionTable::words(), ViscosityTable::words(),
                              ParticleShiftingTable::words()})
    {
        for (const std::string& word : words) known.push_back(word + "Coeffs");
    }
    const std::vector<std::string> chosen
    {
        models.lookup<std::string>("surfaceTension") + "Coeffs", models.lookup<std::string>("wetting") + "Coeffs",
        models.lookup<std::string>("viscosity") + "Coeffs", models.lookupOr<std::string>("velocityCorrection", "none") + "Coeffs",
        models.lookupOr<std::string>("particleShifting", "none") + "Coeffs"
    };
    const auto contains = [](const auto& list, const std::string& key)
    {
        return std::find(list.begin(), list.end(), key) != list.end();
    };
    for (const std::string& key : models.keys())
    {
        if (contains(known, key) && !contains(chosen, key)) models.subDict(key).markUsed();
    }
}

}

Models::Models(const std::filesystem::path& casePath, const Dictionary& solution, Liquid& liquid, const Walls& walls)
:
    dict(Dictionary::read(casePath / "constant/models")),
    freeSurface(std::make_unique<FreeSurface>()),
    bodyForce(BodyForce::New(dict, casePath / "constant", liquid)),
    forces(dict, liquid, walls, *freeSurface),
    pressure(Pressure::New(dict, solution, liquid, walls, *freeSurface)),
    velocityCorrection(VelocityCorrection::New(dict, liquid)),
    viscosity(Viscosity::New(dict, liquid)),
    particleShifting(ParticleShifting::New(dict, liquid, walls, *freeSurface))
{
    toleratePassiveCoefficients(dict);
    dict.refuseUnused();
    if (forces.usesContactAngles() && walls.particles() + walls.surfaces() > 0) angles = walls.readAngles();
    if (angles && angles->laws) holdLines(casePath, liquid);
}

void Models::holdLines(const std::filesystem::path& casePath, Liquid& liquid)
{
    if (!forces.wetting().continuesSurface())
    {
        throw FatalInputError
        (
            dict.where("wetting"), "Laws of contact lines in " + (casePath / "constant/wettability").string()
          + " need a surface that goes on into walls, and wetting " + dict.lookup<std::string>("wetting") + " has none",
            "wetting extendedSurface; or walls whose contact angles are constant"
        );
    }
    heldLine.emplace(liquid);
    freeSurface->hold(heldLine->angle());
}

void Models::refuseParts() const
{
    const auto refuse = [&](const std::string& kind, const auto& model)
    {
        const std::string word = dict.lookupOr<std::string>(kind, "none");
        if (word == "none" || model.seesGhosts()) return;
        throw FatalInputError
        (
            dict.where(kind), "The liquid cannot be cut into parts with " + kind + " " + word + ": the model does not say that it sees the particles of other parts",
            "a model whose seesGhosts() is true, as those of this program are; or one process"
        );
    };
    refuse("pressure", *pressure);
    refuse("surfaceTension", forces.tension());
    refuse("wetting", forces.wetting());
    refuse("velocityCorrection", *velocityCorrection);
    refuse("viscosity", *viscosity);
    refuse("particleShifting", *particleShifting);
}

void Models::takeEffect(const Liquid& liquid, Walls& walls) const
{
    walls.use(liquid, {freeSurface->support(), freeSurface->agreed().closest, angles});
}

}
