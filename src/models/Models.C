// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/Models.H"

#include <set>

namespace shizuku
{

namespace
{

template<class Table>
ModelKind modelKindOf(const std::string& keyword, const std::string& usual, bool hasCoeffs)
{
    return {keyword, usual, hasCoeffs, Table::summaries()};
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
        modelKindOf<PressureTable>("pressure", "", false), modelKindOf<SurfaceTensionTable>("surfaceTension", "", true), modelKindOf<WettingTable>("wetting", "", true),
        modelKindOf<ViscosityTable>("viscosity", "", true), modelKindOf<VelocityCorrectionTable>("velocityCorrection", "none", true),
        modelKindOf<ParticleShiftingTable>("particleShifting", "none", true), modelKindOf<BodyForceTable>("bodyForce", "", false)
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

void Models::refuseGhostBlind(const std::string& what) const
{
    const std::map<std::string, const Model*> models = byKeyword();
    for (const ModelKind& kind : modelKinds())
    {
        const std::string word = kind.chosen(dict);
        if (word == "none" || models.at(kind.keyword)->seesGhosts()) continue;
        throw FatalInputError
        (
            dict.where(kind.keyword),
            what + " with " + kind.keyword + " " + word + ": the model does not say that it sees ghost particles",
            "a model whose seesGhosts() is true, as those of this program are; or one process, and open sides"
        );
    }
}

std::map<std::string, const Model*> Models::byKeyword() const
{
    return
    {
        {"pressure", pressure.get()}, {"surfaceTension", &forces.tension()}, {"wetting", &forces.wetting()}, {"viscosity", viscosity.get()},
        {"velocityCorrection", velocityCorrection.get()}, {"particleShifting", particleShifting.get()}, {"bodyForce", bodyForce.get()}
    };
}

void Models::takeEffect(const Liquid& liquid, Walls& walls) const
{
    walls.use(liquid, {freeSurface->support(), freeSurface->agreed().closest, angles});
}

}
