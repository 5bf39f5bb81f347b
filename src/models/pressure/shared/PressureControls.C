#include "models/pressure/shared/PressureControls.H"

#include "maths/Lattice.H"

namespace shizuku
{

float bulkSquares(const Liquid& liquid)
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

PressureControls PressureControls::read(const Dictionary& dict, const Liquid& liquid)
{
    PressureControls c{IterationControls::read(dict, {2, 10, 1e-3}), 0, 0};
    c.relaxation = float(dict.lookupOr("relaxation", 0.3));
    c.epsilon = float(dict.lookupOr("epsilon", 1e-3)) * bulkSquares(liquid);
    refuseIf(!(c.relaxation > 0 && c.relaxation < 2), dict, "relaxation", "more than 0 and less than 2");
    refuseIf(!(c.epsilon >= 0), dict, "epsilon", "0 or more");
    return c;
}

}
