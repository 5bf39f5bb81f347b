// SPDX-License-Identifier: GPL-3.0-or-later
// Mueller, Charypar and Gross 2003, Particle-based fluid simulation for interactive applications: curvature from the
// smoothed colour field.
//
//     c_i = sum_j m/rho_j W_ij,    n = grad c,    kappa = -lap c/|n|                    (15) to (18)
//     f_i = -sigma lap c n/|n|    where |n| exceeds a threshold,   a_i = f_i/rho_i      (19)
//
// W is the paper's poly6 over the kernel's support, whatever the case's kernel: its Laplacian is smooth. n points into the liquid.
// Walls take no part, and the paper has no contact angle: wetting none. The forces of pairs are not equal and opposite, so
// momentum is not kept.
//
//     surfaceTension      Mueller2003;
//     Mueller2003Coeffs   { threshold 0.3; }       // of |n|, over that of a planar surface

#include "models/density/Density.H"
#include "models/surfaceTension/SurfaceTension.H"
#include "particles/NeighbourLoop.H"

namespace shizuku
{

namespace
{

struct Poly6
{
    scalar h, scale;

    explicit Poly6(scalar support) : h(support), scale(945 / (32 * kernels::pi * support * support * support)) {}

    // W'(r)/r and lap W, times h^2.
    HOST_DEVICE scalar g(scalar q2) const { return q2 < 1 ? -scale * (1 - q2) * (1 - q2) : 0; }
    HOST_DEVICE scalar laplacian(scalar q2) const { return q2 < 1 ? -scale * (1 - q2) * (3 - 7 * q2) : 0; }
};

struct ColourForce
{
    Poly6 W;
    scalar volume, sigma, restDensity, least;       // least: of |n|
    Span<const Position> x;
    Span<const scalar> density;
    NeighbourView near;
    Span<Vec3> acceleration;

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        const scalar perSquare = 1 / (W.h * W.h);
        scalar laplacian = volume / density[i] * W.laplacian(0);
        Vec3 n;
        near.forEach(i, [&](int j)
        {
            const Vec3 r = xi - x[j];
            const scalar q2 = squared(r) * perSquare, share = volume / density[j];
            n += share * W.g(q2) * perSquare * r;
            laplacian += share * W.laplacian(q2);
        });
        const scalar length = norm(n);
        if (length <= least) return;
        acceleration[i] -= sigma * laplacian * perSquare / (length * restDensity * density[i]) * n;
    }
};

class Mueller2003 : public SurfaceTension
{
public:
    Mueller2003(const Dictionary& coeffs, Liquid& liquid, const Walls&, FreeSurface&)
    :
        W_(liquid.support()),
        density_(requirePredictedDensity(liquid)),
        sigma_(liquid.units().toScaled(liquid.properties().surfaceTension, dimensions::surfaceTension))
    {
        const double threshold = coeffs.lookupOr("threshold", 0.3);
        if (!(threshold > 0 && threshold < 1))
        {
            throw FatalInputError(coeffs.where("threshold"), "The threshold is out of range", "between 0 and 1");
        }
        // At a planar surface |grad c| is the area integral of W, 315/(256 h) for poly6.
        least_ = scalar(threshold) * 315 / (256 * W_.h);
    }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, Buffer<Vec3>& acceleration) override
    {
        computePredictedDensity(liquid, near, walls, density_);
        NeighbourLoop(liquid, {valuesOf(density_)}, {placesOf(liquid.predicted)}).forEach(ColourForce
        {
            W_, liquid.particleVolume(), sigma_, liquid.restDensity(), least_, liquid.predicted.span(),
            density_.span(), near.view(), acceleration.span()
        });
    }

    std::optional<Columns> readsOfNeighbours(Liquid&) const override { return Columns{}; }

private:
    Poly6 W_;
    Buffer<scalar>& density_;
    scalar sigma_, least_ = 0;
};

const SurfaceTensionTable::Add<Mueller2003> registered{"Mueller2003", "curvature of the smoothed colour field (Mueller, Charypar and Gross 2003)"};

}

}
