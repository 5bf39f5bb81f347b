#include "geometry/thetaModels/ThetaModel.H"

#include <sstream>

namespace shizuku
{

double readTheta(const Dictionary& dict, const std::string& key)
{
    const double theta = dict.lookup<double>(key);
    if (!(theta >= 0 && theta <= 180))
    {
        std::ostringstream found;
        found << "The contact angle " << key << " of " << dict.name() << " is " << theta;
        throw FatalInputError(dict.where(key), found.str(), "degrees from 0 to 180");
    }
    return theta;
}

}
