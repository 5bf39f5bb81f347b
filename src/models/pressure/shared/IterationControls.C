// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/pressure/shared/IterationControls.H"

namespace shizuku
{

void refuseIf(bool outOfRange, const Dictionary& dict, const std::string& key, const std::string& expected)
{
    if (outOfRange) throw FatalInputError(dict.where(key), "Entry '" + key + "' is out of range", expected);
}

IterationControls IterationControls::read(const Dictionary& dict, const IterationControls& usual)
{
    IterationControls c;
    c.minIterations = dict.lookupOr("minIterations", usual.minIterations);
    c.maxIterations = dict.lookupOr("maxIterations", usual.maxIterations);
    c.tolerance = dict.lookupOr("tolerance", usual.tolerance);
    refuseIf(c.maxIterations < 1, dict, "maxIterations", "1 or more");
    refuseIf(c.minIterations < 0 || c.minIterations > c.maxIterations, dict, "minIterations", "0 to maxIterations");
    refuseIf(!(c.tolerance >= 0), dict, "tolerance", "0 (every iteration is made) or more");
    return c;
}

}
