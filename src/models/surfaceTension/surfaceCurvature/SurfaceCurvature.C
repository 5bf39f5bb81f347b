// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/surfaceTension/surfaceCurvature/SurfaceCurvature.H"

#include "walls/HalfSpace.H"

namespace shizuku
{

namespace
{

// b by the depth below a planar surface, evenly spaced from none to a support.
std::vector<scalar> weightsByDepth(const WendlandC2& W, scalar steepest)
{
    const auto plane = tabulateHalfSpace(W);
    const HalfSpaceView view{{plane.data(), int(plane.size())}, W.h};
    std::vector<scalar> weights(101);
    for (int k = 0; k <= 100; ++k) weights[k] = surfaceWeight(view(0.01f * scalar(k) * W.h).gradient / steepest);
    return weights;
}

}

SurfaceCurvature::SurfaceCurvature(const Dictionary& coeffs, const Liquid& liquid, FreeSurface& surface, scalar sigma, WedgePart part)
:
    surface_(surface),
    part_(part)
{
    const scalar support = scalar(coeffs.lookupOr("support", double(FreeSurface::usualSupport(liquid))));
    if (!(support >= FreeSurface::leastSupport(liquid) && support <= 8))
    {
        throw FatalInputError
        (
            coeffs.where("support"), "The support of the surface is out of range",
            "1.5 times the kernel's to 8 spacings"
        );
    }
    surface.require(liquid, support, sigma / liquid.spacing());
}

CurvatureField SurfaceCurvature::makeField() const
{
    const int room = surface_.particles().indices.size();
    return {Buffer<Vec3>(room), Buffer<scalar>(room)};
}

ExtendedLiquidView SurfaceCurvature::extendedInto(const Walls& walls)
{
    const WendlandC2 W = surface_.kernel();
    if (!extended_) extended_.emplace(W, walls.contactAngles(W.h), weightsByDepth(W, surface_.steepest()), part_);
    return extended_->view();
}

}
