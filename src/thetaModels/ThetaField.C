// SPDX-License-Identifier: GPL-3.0-or-later
#include "thetaModels/ThetaField.H"

#include "caseFiles/SampledWall.H"
#include "core/dictionary/KeywordPattern.H"
#include "core/paths/Existence.H"
#include "meshes/ObjFile.H"
#include "meshes/StlFile.H"
#include "thetaModels/ContactAngleLaw.H"
#include "thetaModels/ThetaModel.H"

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace shizuku
{

namespace
{

Dictionary entryOf(const Dictionary& wettability, const std::string& name)
{
    if (!wettability.found(name))
    {
        throw FatalInputError
        (
            wettability.where(), "The patch or wall '" + name + "' has no contact angle in " + wettability.name(),
            name + " { theta 60; }      // degrees"
        );
    }
    return wettability.subDict(name);
}

// Where a line at rest has it, by a law.
class ThetaAtRest : public ThetaModel
{
public:
    explicit ThetaAtRest(std::unique_ptr<ContactAngleLaw> law) : law_(std::move(law)) {}

    double theta(const Vector3& x) const override { return law_->at(x).theta; }

private:
    std::unique_ptr<ContactAngleLaw> law_;
};

std::unique_ptr<ThetaModel> readModel
(
    const Dictionary& wettability, const std::string& patch, const std::filesystem::path& casePath
)
{
    const Dictionary dict = entryOf(wettability, patch);
    if (auto law = readLaw(dict, casePath)) return std::make_unique<ThetaAtRest>(std::move(law));
    const std::string type = dict.lookupOr<std::string>("type", "constant");
    const SourceLocation where = dict.found("type") ? dict.where("type") : dict.where();
    return ThetaModelTable::New("contact-angle", type, where, dict, casePath);
}

// A keyword may be a pattern that stands for several names.
bool meansAnyOf(const std::string& keyword, const std::vector<std::string>& names, const SourceLocation& where)
{
    if (std::find(names.begin(), names.end(), keyword) != names.end()) return true;
    const KeywordPattern pattern(keyword, where);
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) { return pattern.matches(name); });
}

// Where the patches' names come from: "; wall 'hills' has the patches top, side". Surfaces that name none have the wall's.
std::string patchesOfWalls(const std::filesystem::path& casePath)
{
    if (!isThere(casePath/"constant/walls")) return "";
    std::string text;
    for (const SampledWall& wall : readSampledWalls(casePath))
    {
        const std::string extension = boost::algorithm::to_lower_copy(wall.file.extension().string());
        if (!isThere(wall.file) || (extension != ".stl" && extension != ".obj")) continue;
        const std::vector<std::string> patches =
            (extension == ".stl" ? readStl(wall.file, wall.name) : readObj(wall.file, wall.name)).patches;
        text += "; wall '" + wall.name + "' has the " + (patches.size() > 1 ? "patches " : "patch ") + patches.front();
        for (std::size_t i = 1; i < patches.size(); ++i) text += ", " + patches[i];
    }
    return text;
}

}

double wallTheta(const Dictionary& wettability, const std::string& wall, const std::filesystem::path& casePath)
{
    const Dictionary dict = entryOf(wettability, wall);
    if (const auto law = readLaw(dict, casePath))
    {
        if (law->isUniform()) return law->at({}).theta;
        throw FatalInputError
        (
            dict.where("law"), "The law of the analytic wall '" + wall + "' has angles that are distributions",
            "numbers, the same everywhere; or a wall of type particles in constant/walls, which takes distributions"
        );
    }
    const std::string type = dict.lookupOr<std::string>("type", "constant");
    if (type != "constant")
    {
        throw FatalInputError
        (
            dict.where("type"),
            "The analytic wall '" + wall + "' has a contact-angle distribution, type " + type,
            "type constant, the same angle everywhere; or a wall of type particles in constant/walls, which takes any type"
        );
    }
    return readTheta(dict, "theta");
}

void refuseUnknownWalls
(
    const Dictionary& wettability, const std::vector<std::string>& names, const std::filesystem::path& casePath
)
{
    for (const std::string& keyword : wettability.dictKeys())
    {
        if (!meansAnyOf(keyword, names, wettability.where(keyword)))
        {
            throw FatalInputError
            (
                wettability.where(keyword), "There is no patch or wall '" + keyword + "'",
                "the patches of constant/solid and the analytic walls of constant/walls" + patchesOfWalls(casePath), names, keyword
            );
        }
    }
}

std::vector<double> caseTheta(const std::filesystem::path& casePath)
{
    const SolidParticles solid = useSolidParticles(casePath) ? readSolidParticles(casePath) : SolidParticles();
    return thetaField
    (
        solid, readAnalyticSurfaces(Dictionary::read(casePath/"constant/walls")), Dictionary::read(casePath/"constant/wettability"),
        casePath
    );
}

namespace
{

// Images are known only where VTK is linked.
bool knowsAllTypes(const Dictionary& wettability)
{
    const std::vector<std::string> types = ThetaModelTable::words(), names = wettability.dictKeys();
    return std::all_of(names.begin(), names.end(), [&](const std::string& name)
    {
        const auto type = wettability.subDict(name).lookupOr<std::string>("type", "constant");
        return std::find(types.begin(), types.end(), type) != types.end();
    });
}

std::string difference(const std::vector<double>& theta, const std::filesystem::path& folder)
{
    constexpr double digits = 1e-3;         // degrees
    const std::vector<double> written = readTheta(folder, theta.size());
    std::size_t others = 0, first = 0;
    for (std::size_t i = 0; i < theta.size(); ++i)
    {
        if (std::abs(theta[i] - written[i]) <= digits) continue;
        if (others++ == 0) first = i;
    }
    if (others == 0) return "";
    std::ostringstream text;
    text << "constant/wettability gives " << others << " of " << theta.size() << " solid particles other contact angles than "
         << (folder/"solid/theta").string() << " has, which is what counts: " << theta[first] << " degrees instead of " << written[first]
         << "\nExpected: the same angles in both; sampleTheta writes those of constant/wettability to 0/solid/theta";
    return text.str();
}

}

std::string otherTheta(const std::filesystem::path& casePath, const std::filesystem::path& folder)
{
    try
    {
        if (!knowsAllTypes(Dictionary::read(casePath/"constant/wettability"))) return "";
        return difference(caseTheta(casePath), folder);
    }
    catch (const FatalInputError& error)
    {
        return std::string(error.what()) + "\nThe contact angles of " + (folder/"solid/theta").string() + " stay in force";
    }
}

std::vector<double> readTheta(const std::filesystem::path& folder, std::size_t particles)
{
    const FieldData field = readField(folder/"solid/theta", FieldType::scalar, dimensions::none, long(particles));
    std::vector<double> theta(particles);
    for (std::size_t i = 0; i < particles; ++i) theta[i] = field(i);
    return theta;
}

void writeTheta(const std::filesystem::path& folder, const std::vector<double>& theta, const WriteFormat& format)
{
    FieldData field{"theta", FieldType::scalar, dimensions::none, false, theta};
    if (std::adjacent_find(theta.begin(), theta.end(), std::not_equal_to<>()) == theta.end())
    {
        field.uniform = true;
        field.values.resize(1);
    }
    writeField(folder/"solid"/"theta", field, format);
}

std::vector<double> thetaField
(
    const SolidParticles& solid, const std::vector<AnalyticSurface>& walls, const Dictionary& wettability,
    const std::filesystem::path& casePath
)
{
    std::vector<std::string> names = solid.patches;
    for (const AnalyticSurface& wall : walls) names.push_back(wall.name);
    refuseUnknownWalls(wettability, names, casePath);
    std::vector<std::unique_ptr<ThetaModel>> models;        // one a patch
    for (const std::string& patch : solid.patches) models.push_back(readModel(wettability, patch, casePath));
    for (const AnalyticSurface& wall : walls) wallTheta(wettability, wall.name, casePath);
    wettability.refuseUnused();

    std::vector<double> theta(solid.positions.size());
    for (std::size_t i = 0; i < theta.size(); ++i)
    {
        theta[i] = models[solid.patch[i]]->theta(solid.positions[i]);
    }
    return theta;
}

}
