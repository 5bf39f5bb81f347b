// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/pressure/shared/PressureControls.H"

#include "maths/Lattice.H"

namespace shizuku
{

scalar bulkSquares(const Liquid& liquid)
{
    return std::visit
    (
        [&](const auto& W)
        {
            const auto square = [&](scalar r) { return W.g(r) * r * W.g(r) * r; };
            return liquid.particleVolume() * latticeSum(liquid.spacing(), W.h, square);
        },
        liquid.kernel()
    );
}

PressureControls PressureControls::read(const Dictionary& dict, const Liquid& liquid, const UsualIterations& usual)
{
    PressureControls c{IterationControls::read(dict, {2, usual.maxIterations, 1e-3}), 0, 0};
    c.relaxation = scalar(dict.lookupOr("relaxation", usual.relaxation));
    c.epsilon = scalar(dict.lookupOr("epsilon", 1e-3)) * bulkSquares(liquid);
    refuseIf(!(c.relaxation > 0 && c.relaxation < 2), dict, "relaxation", "more than 0 and less than 2");
    refuseIf(!(c.epsilon >= 0), dict, "epsilon", "0 or more");
    return c;
}

}
