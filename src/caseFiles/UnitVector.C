// SPDX-License-Identifier: GPL-3.0-or-later
#include "caseFiles/UnitVector.H"

namespace shizuku
{

Vector3 readUnitVector(const Dictionary& dict, const std::string& key)
{
    const Vector3 vector = dict.lookup<std::array<double, 3>>(key);
    const double l = length(vector);
    if (!(l > 0) || !std::isfinite(l))
    {
        throw FatalInputError
        (
            dict.where(key), "The " + key + " " + str(vector) + " of " + dict.name() + " has no direction",
            "a vector of any length but zero"
        );
    }
    return vector/l;
}

}
