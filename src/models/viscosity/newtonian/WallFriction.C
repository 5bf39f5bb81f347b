// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/viscosity/newtonian/WallFriction.H"

#include "maths/Simpson.H"
#include "models/viscosity/newtonian/SlipLength.H"

#include <cmath>

namespace shizuku
{

namespace
{

// What the layers at walls lack, m.
Buffer<scalar>* missingField(bool wanted, Liquid& liquid)
{
    if (!wanted) return nullptr;
    return &liquid.fields().require<scalar>
    ({
        .name = "wallLayer", .dimensions = dimensions::kinematicViscosity, .written = true, .restarted = true
    });
}

// Of a slip length shorter than the spacing.
ContactLineDrag lineDrag(const Liquid& liquid, scalar slip, scalar nu)
{
    const scalar ofPlane = std::visit([](const auto& W)         // the gradient of a half-space at its plane
    {
        return scalar(integrate(0, W.h, [&](double r) { return -kernels::pi * (r * r) * W.g(scalar(r)) * r; }));
    }, liquid.kernel());
    return {nu, slip > 0 && slip < liquid.spacing() ? std::log(liquid.spacing() / slip) : 0, ofPlane};
}

}

WallFriction::WallFriction(const Dictionary& coeffs, Liquid& liquid, scalar nu)
:
    noSlip_(coeffs.lookupOr("noSlip", true)),
    missing_(missingField(coeffs.lookupOr("startedLayers", true) && noSlip_, liquid)),
    nu_(nu),
    slip_(liquid.units().toScaled(coeffs.lookupDimensionedOr("slipLength", dimensions::length, usualSlipLength), dimensions::length)),
    line_(lineDrag(liquid, slip_, nu)),
    plane_(tabulateHalfSpace(liquid.kernel()))
{
    if (!(slip_ >= 0)) throw FatalInputError(coeffs.where("slipLength"), "Coefficient slipLength is out of range", "a length of 0 m or more");
}

Buffer<scalar> WallFriction::layers() const
{
    Buffer<scalar> copy(missing_ ? missing_->size() : 0);
    if (copy.size() > 0) device::copyOnDevice(copy.span().data, std::as_const(*missing_).span().data, copy.size() * sizeof(scalar));
    return copy;
}

}
