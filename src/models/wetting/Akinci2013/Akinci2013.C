// SPDX-License-Identifier: GPL-3.0-or-later
// Adhesion of Akinci et al. 2013: solids pull, and pull only; the shape of the surface does not enter.
//
//     a_ik = -beta rho0 V_k A(r) r_ik/r,   A(r) = 0.007/h^3.25 (-4 r^2/h + 6 r - 2 h)^(1/4)   for h/2 < r <= h
//
// The root's argument is rounded below zero near r = h and r = h/2; it is clamped there. The paper gives no way from
// theta to beta. Unless the case gives a number, adhesion does the share (1 + cos theta)/2 of cohesion's work, equation
// (28) of Fujisawa et al. 2014 as an integral:
//
//     beta = gamma (1 + cos theta)/2  int C r^4 dr / int A r^4 dr
//
//     wetting           Akinci2013;
//     Akinci2013Coeffs  { beta 1.2; }         // m4/(kg s2)

#include "maths/CohesionSpline.H"
#include "models/wetting/Wetting.H"

namespace shizuku
{

namespace
{

constexpr Dimensions adhesionDimensions{{-1, 4, -2, 0, 0, 0, 0}};

struct AdhesionSpline
{
    scalar h;

    HOST_DEVICE scalar operator()(scalar r) const
    {
        const scalar q = r / h;
        if (q <= 0.5f || q > 1) return 0;
        return 0.007f / (h * h * h) * sqrt(sqrt(fmax(-4 * q * q + 6 * q - 2, 0)));
    }
};

struct Adhesion
{
    AdhesionSpline A;
    scalar fullBeta;                    // of theta = 0
    scalar beta;                        // the case's number; negative: from fullBeta and theta
    scalar restDensity;
    Span<const Position> x;
    WallParticlesView solid;
    Span<Vec3> acceleration;

    HOST_DEVICE void operator()(int i) const
    {
        const Position xi = x[i];
        Vec3 sum;
        solid.near.forEach(i, [&](int k)
        {
            const Vec3 r = xi - solid.position[k];
            const scalar distance = norm(r);
            const scalar strength = beta < 0 ? 0.5f * fullBeta * (1 + solid.cosTheta[k]) : beta;
            if (distance > 0) sum -= strength * restDensity * solid.volume[k] * A(distance) / distance * r;
        });
        acceleration[i] += sum;
    }
};

class Akinci2013 : public Wetting
{
public:
    Akinci2013(const Dictionary& coeffs, Liquid& liquid, const Walls& walls, const SurfaceTension& tension)
    :
        fullBeta_(0), beta_(-1)
    {
        if (coeffs.found("beta"))
        {
            beta_ = liquid.units().toScaled
            (
                coeffs.lookupPositive("beta", adhesionDimensions, true), adhesionDimensions
            );
        }
        else
        {
            const double ratio = separationIntegral(CohesionSpline{1}) / separationIntegral(AdhesionSpline{1});
            fullBeta_ = scalar(ratio * requirePairCoefficients(tension, coeffs).cohesion);
        }
        if (walls.surfaces() > 0)
        {
            throw FatalInputError
            (
                coeffs.where(), "The wetting model Akinci2013 acts between particles, and this case has analytic walls",
                "walls of type particles, or another wetting model"
            );
        }
    }

    // Where beta is given it says how a wall attracts.
    bool usesContactAngles() const override { return beta_ < 0; }
    std::optional<Columns> readsOfNeighbours(Liquid&) const override { return Columns{}; }

    void apply(Liquid& liquid, const Neighbourhood&, const Walls& walls, Buffer<Vec3>& acceleration) override
    {
        if (walls.particles() == 0) return;
        forEach(liquid.owned(), Adhesion
        {
            {liquid.support()}, fullBeta_, beta_, liquid.restDensity(), liquid.predicted.span(), walls.view(liquid).particles,
            acceleration.span()
        });
    }

private:
    scalar fullBeta_, beta_;
};

const WettingTable::Add<Akinci2013> registered{"Akinci2013", "adhesion: solids pull (Akinci, Akinci and Teschner 2013)"};

}

}
