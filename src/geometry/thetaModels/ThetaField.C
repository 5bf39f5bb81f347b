#include "geometry/thetaModels/ThetaField.H"

#include "geometry/thetaModels/ThetaModel.H"

#include <algorithm>
#include <regex>

namespace shizuku
{

namespace
{

std::unique_ptr<ThetaModel> readModel(const Dictionary& wettability, const std::string& name)
{
    if (!wettability.found(name))
    {
        throw FatalInputError
        (
            wettability.where(), "The patch or wall '" + name + "' has no contact angle in " + wettability.name(),
            name + " { theta 60; }      // degrees"
        );
    }
    const Dictionary dict = wettability.subDict(name);
    const std::string type = dict.lookupOr<std::string>("type", "constant");
    return ThetaModelTable::New("contact-angle", type, dict.found("type") ? dict.where("type") : dict.where(), dict);
}

// A keyword may be a pattern that stands for several names.
bool meansAnyOf(const std::string& keyword, const std::vector<std::string>& names)
{
    if (std::find(names.begin(), names.end(), keyword) != names.end()) return true;
    const std::regex pattern(keyword, std::regex::extended);
    return std::any_of
    (
        names.begin(), names.end(), [&](const std::string& name) { return std::regex_match(name, pattern); }
    );
}

}

void refuseUnknownWalls(const Dictionary& wettability, const std::vector<std::string>& names)
{
    for (const std::string& keyword : wettability.dictKeys())
    {
        if (!meansAnyOf(keyword, names))
        {
            throw FatalInputError
            (
                wettability.where(keyword), "There is no patch or wall '" + keyword + "'",
                "the patches of constant/solid and the analytic walls of constant/walls", names, keyword
            );
        }
    }
}

std::vector<double> thetaField
(
    const SolidParticles& solid, const std::vector<AnalyticSurface>& walls, const Dictionary& wettability
)
{
    std::vector<std::string> names = solid.patches;
    for (const AnalyticSurface& wall : walls) names.push_back(wall.name);
    refuseUnknownWalls(wettability, names);
    std::vector<std::unique_ptr<ThetaModel>> models;        // the patches', then the walls', which are only checked
    for (const std::string& name : names) models.push_back(readModel(wettability, name));
    wettability.refuseUnused();

    std::vector<double> theta(solid.positions.size());
    for (std::size_t i = 0; i < theta.size(); ++i)
    {
        theta[i] = models[solid.patch[i]]->theta(solid.positions[i], solid.normals[i]);
    }
    return theta;
}

}
