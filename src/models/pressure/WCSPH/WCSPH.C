// SPDX-License-Identifier: GPL-3.0-or-later
// Weakly compressible SPH: Becker and Teschner 2007, Weakly compressible SPH for free surface flows.
//
//     p_i = B ((rho_i/rho0)^7 - 1),   B = rho0 c^2/7                                   Tait's equation
//     a_i = -sum_j m (p_i/rho_i^2 + p_j/rho_j^2) grad W_ij                             the momentum equation
//     c   = v/sqrt(eta)                                                                shared/SoundSpeed.H
//
// Walls push with the particle's own pressure, p_i/rho_i^2 (Akinci et al. 2012, equation (9)). The density is the sum (8) of
// doc/notebook/theory/pbf.md; viscosity and tension are models of their own, so nothing of the paper's is in here.
//
//     pressure    WCSPH;                  // in constant/models
//     pressure    { maxDensityVariation 0.01; maxSpeed 1; }       // in system/solution

#include "models/pressure/shared/CompressiblePressure.H"

namespace shizuku
{

namespace
{

struct Tait
{
    scalar B;

    Tait(scalar restDensity, scalar c) : B(restDensity * c * c / 7) {}

    HOST_DEVICE scalar pressure(scalar D) const
    {
        const scalar cube = D * D * D;
        return B * (cube * cube * D - 1);
    }

    HOST_DEVICE scalar share(scalar p, scalar D, scalar) const { return p / (D * D); }
};

const PressureTable::Add<CompressiblePressure<Tait>> registered{"WCSPH", "weakly compressible SPH (Becker and Teschner 2007)"};

}

}
