// SPDX-License-Identifier: GPL-3.0-or-later
#include "thetaModels/ThetaModel.H"

#include <sstream>

namespace shizuku
{

namespace
{

double checked(double theta, const Dictionary& dict, const std::string& key)
{
    if (!(theta >= 0 && theta <= 180))
    {
        std::ostringstream found;
        found << "The contact angle " << key << " of " << dict.name() << " is " << theta;
        throw FatalInputError(dict.where(key), found.str(), "degrees from 0 to 180");
    }
    return theta;
}

}

double readTheta(const Dictionary& dict, const std::string& key)
{
    return checked(dict.lookup<double>(key), dict, key);
}

std::pair<double, double> readThetaPair(const Dictionary& dict, const std::string& key)
{
    const auto angles = dict.lookup<std::vector<double>>(key);
    if (angles.size() != 2)
    {
        throw FatalInputError
        (
            dict.where(key), "The list " + key + " of " + dict.name() + " holds " + std::to_string(angles.size()) + " angles",
            "two of them, as in " + key + " (30 110);"
        );
    }
    return {checked(angles[0], dict, key), checked(angles[1], dict, key)};
}

}
