#include "models/pressure/shared/PressureControls.H"

#include "maths/Lattice.H"

namespace shizuku
{

namespace
{

// Sum of |V grad W|^2 over the cubic lattice: the scale of epsilon.
float bulkSum(const Liquid& liquid)
{
    return std::visit
    (
        [&](const auto& W)
        {
            const auto square = [&](float r) { return W.g(r) * r * W.g(r) * r; };
            return liquid.particleVolume() * latticeSum(liquid.spacing(), W.h, square);
        },
        liquid.kernel()
    );
}

}

PressureControls PressureControls::read(const Dictionary& dict, const Liquid& liquid)
{
    PressureControls c;
    c.minIterations = dict.lookupOr("minIterations", 2);
    c.maxIterations = dict.lookupOr("maxIterations", 10);
    c.tolerance = dict.lookupOr("tolerance", 1e-3);
    c.relaxation = float(dict.lookupOr("relaxation", 0.3));
    c.epsilon = float(dict.lookupOr("epsilon", 1e-3)) * bulkSum(liquid);
    const auto refuse = [&](const std::string& key, bool wrong, const std::string& expected)
    {
        if (wrong) throw FatalInputError(dict.where(key), "Entry '" + key + "' is out of range", expected);
    };
    refuse("maxIterations", c.maxIterations < 1, "1 or more");
    refuse("minIterations", c.minIterations < 0 || c.minIterations > c.maxIterations, "0 to maxIterations");
    refuse("tolerance", !(c.tolerance >= 0), "0 (every iteration is made) or more");
    refuse("relaxation", !(c.relaxation > 0 && c.relaxation < 2), "more than 0 and less than 2");
    refuse("epsilon", !(c.epsilon >= 0), "0 or more");
    return c;
}

}
