// SPDX-License-Identifier: GPL-3.0-or-later
#include "thetaModels/ContactAngleLaw.H"

#include "core/angles/Degrees.H"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace shizuku
{

namespace
{

// Halfway between Young's forces of both: where neither an advancing nor a receding line is nearer.
double middle(double receding, double advancing)
{
    return degrees(std::acos(0.5*(std::cos(radians(receding)) + std::cos(radians(advancing)))));
}

// Contact angles of OpenFOAM and of its extensions: contactAngle, constantAlphaContactAngle, dynamicKistlerAlphaContactAngle.
void refuseForeignTypes(const Dictionary& dict)
{
    if (!dict.found("type")) return;
    const auto type = dict.lookup<std::string>("type");
    if (type != "contactAngle" && !type.ends_with("ContactAngle")) return;
    const auto has = [&](const char* word) { return type.find(word) != std::string::npos; };
    const char* const expected = has("istler") ? "law kistler; theta0 60;      // degrees, inside the liquid"
        : has("dynamic") ? "law dynamic; theta0 90; thetaAdv 110; thetaRec 70; uTheta 1;      // degrees inside the liquid, m/s; thetaA and thetaR there"
        : "theta 60;      // degrees, inside the liquid; theta0 there";
    throw FatalInputError(dict.where("type"), "'" + type + "' of " + dict.name() + " is a boundary condition of OpenFOAM", expected);
}

// A law that is named where a distribution of angles would be.
void refuseLawAsType(const Dictionary& dict)
{
    const auto type = dict.lookupOr<std::string>("type", "constant");
    const auto laws = ContactAngleLawTable::words(), distributions = ThetaModelTable::words();
    const auto has = [&](const std::vector<std::string>& words) { return std::find(words.begin(), words.end(), type) != words.end(); };
    if (!has(laws) || has(distributions)) return;
    throw FatalInputError(dict.where("type"), "'" + type + "' of " + dict.name() + " is a contact-angle law, no distribution of angles", "law " + type + "; in place of type " + type + ";");
}

// Angles of a law where no law is named.
void refuseAnglesWithoutLaw(const Dictionary& dict)
{
    for (const std::string key : {"thetaAdv", "thetaRec", "theta0", "uTheta"})
    {
        if (!dict.found(key)) continue;
        throw FatalInputError
        (
            dict.where(key), "'" + key + "' of " + dict.name() + " belongs to a contact-angle law, and none is named",
            "law hysteresis; with thetaAdv and thetaRec, or another law; or theta alone", ContactAngleLawTable::words()
        );
    }
}

}

LawAngle::LawAngle(const Dictionary& dict, const std::string& key, const std::filesystem::path& casePath)
{
    if (!dict.isDict(key))
    {
        uniform_ = readTheta(dict, key);
        return;
    }
    const Dictionary distribution = dict.subDict(key);
    const auto type = distribution.lookup<std::string>("type");
    model_ = ThetaModelTable::New("contact-angle", type, distribution.where("type"), distribution, casePath);
}

std::unique_ptr<ContactAngleLaw> readLaw(const Dictionary& dict, const std::filesystem::path& casePath)
{
    refuseForeignTypes(dict);
    refuseLawAsType(dict);
    const auto word = dict.lookupOr<std::string>("law", "constant");
    if (word == "constant")
    {
        refuseAnglesWithoutLaw(dict);
        return nullptr;
    }
    if (const auto laws = ContactAngleLawTable::words(); std::find(laws.begin(), laws.end(), word) == laws.end())
    {
        std::vector<std::string> choices{"constant"};
        choices.insert(choices.end(), laws.begin(), laws.end());
        throw FatalInputError(dict.where("law"), "Unknown contact-angle law '" + word + "'", "one of the laws below", choices, word);
    }
    auto law = ContactAngleLawTable::New("law", word, dict.where("law"), dict, casePath);
    if (law->isUniform()) law->at({});      // whose order is checked at once
    return law;
}

HeldLaw::HeldLaw(const Dictionary& dict, const std::filesystem::path& casePath, Takes takes)
:
    where_(dict.where()), name_(dict.name())
{
    const bool two = takes != Takes::either || dict.found("thetaAdv") || dict.found("thetaRec");
    if (two && takes == Takes::either && dict.found("theta0"))
    {
        throw FatalInputError
        (
            dict.where("theta0"), name_ + " has theta0 beside thetaAdv or thetaRec",
            "theta0 alone; or thetaAdv and thetaRec, from which the line advances and recedes"
        );
    }
    if (two)
    {
        receding_.emplace(dict, "thetaRec", casePath);
        advancing_.emplace(dict, "thetaAdv", casePath);
        where_ = dict.where("thetaRec");
    }
    if (!two || takes == Takes::bothAndTheta0) theta_.emplace(dict, "theta0", casePath);
}

LineAngles HeldLaw::at(const Vector3& x) const
{
    if (!receding_)
    {
        const double theta = (*theta_)(x);
        return {theta, theta, theta};
    }
    const double receding = (*receding_)(x), advancing = (*advancing_)(x);
    const LineAngles angles{receding, theta_ ? (*theta_)(x) : middle(receding, advancing), advancing};
    constexpr double rounding = 1e-9;
    if (!(receding <= advancing && receding <= angles.theta + rounding && angles.theta <= advancing + rounding))
    {
        std::ostringstream found;
        found << "The contact angles of " << name_ << " are not in order: thetaRec " << receding;
        if (theta_) found << ", theta0 " << angles.theta;
        found << ", thetaAdv " << advancing << " degrees";
        if (!isUniform()) found << " at " << str(x) << " m";
        throw FatalInputError(where_, found.str(), theta_ ? "thetaRec <= theta0 <= thetaAdv" : "thetaRec <= thetaAdv: a line recedes at a smaller angle than it advances at");
    }
    return angles;
}

bool HeldLaw::isUniform() const
{
    const auto is = [](const std::optional<LawAngle>& angle) { return !angle || angle->isUniform(); };
    return is(receding_) && is(theta_) && is(advancing_);
}

}
