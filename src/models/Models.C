// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/Models.H"

#include <set>

namespace shizuku
{

namespace
{

template<class Table>
ModelKind modelKindOf(const std::string& keyword, const std::string& usual, bool hasCoeffs, const Model& (*chosenOf)(const Models&))
{
    return {keyword, usual, hasCoeffs, Table::summaries(), chosenOf};
}

// A case may keep the coefficients of models that it does not use at present.
void toleratePassiveCoefficients(const Dictionary& dict)
{
    std::set<std::string> chosen, known;
    for (const ModelKind& kind : modelKinds())
    {
        if (!kind.hasCoeffs) continue;
        chosen.insert(kind.chosen(dict) + "Coeffs");
        for (const auto& [word, summary] : kind.models) known.insert(word + "Coeffs");
    }
    for (const std::string& key : dict.keys())
    {
        if (known.contains(key) && !chosen.contains(key)) dict.subDict(key).markUsed();
    }
}

}

std::vector<ModelKind> modelKinds()
{
    return
    {
        modelKindOf<PressureTable>("pressure", "", false, [](const Models& all) -> const Model& { return *all.pressure; }),
        modelKindOf<SurfaceTensionTable>("surfaceTension", "", true, [](const Models& all) -> const Model& { return all.forces.tension(); }),
        modelKindOf<WettingTable>("wetting", "", true, [](const Models& all) -> const Model& { return all.forces.wetting(); }),
        modelKindOf<ViscosityTable>("viscosity", "", true, [](const Models& all) -> const Model& { return *all.viscosity; }),
        modelKindOf<VelocityCorrectionTable>("velocityCorrection", "none", true, [](const Models& all) -> const Model& { return *all.velocityCorrection; }),
        modelKindOf<ParticleShiftingTable>("particleShifting", "none", true, [](const Models& all) -> const Model& { return *all.particleShifting; }),
        modelKindOf<BodyForceTable>("bodyForce", "", false, [](const Models& all) -> const Model& { return *all.bodyForce; })
    };
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

void Models::refuseGhostBlind(Liquid& liquid, const std::string& what) const
{
    for (const ModelKind& kind : modelKinds())
    {
        const std::string word = kind.chosen(dict);
        if (word == "none" || kind.chosenOf(*this).readsOfNeighbours(liquid)) continue;
        throw FatalInputError
        (
            dict.where(kind.keyword),
            what + " with " + kind.keyword + " " + word + ": the model does not say what it reads of ghost particles",
            "a model with readsOfNeighbours(), as those of this program are; or one process, and open sides"
        );
    }
}

void Models::takeEffect(const Liquid& liquid, Walls& walls) const
{
    walls.use(liquid, {freeSurface->support(), freeSurface->agreed().closest, angles});
}

}
