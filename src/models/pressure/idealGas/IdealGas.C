// SPDX-License-Identifier: GPL-3.0-or-later
// The gas of Mueller, Charypar and Gross 2003, Particle-based fluid simulation for interactive applications.
//
//     p_i = k (rho_i - rho0)                                                            (12)
//     f_i = -sum_j m (p_i + p_j)/(2 rho_j) grad W_ij,   a_i = f_i/rho_i                 (10), (8)
//
// In a full neighbourhood the mean of both pressures carries half of grad p: the sum over p_i has no part in it. So what acts
// as a pressure is p/2, and the field p holds that; k = 2 c^2 with the speed of sound c of shared/SoundSpeed.H. Walls push
// with the particle's own pressure.
//
//     pressure    idealGas;               // in constant/models
//     pressure    { maxDensityVariation 0.01; maxSpeed 1; }       // in system/solution

#include "models/pressure/shared/CompressiblePressure.H"

namespace shizuku
{

namespace
{

struct IdealGas
{
    scalar stiffness;                   // rho0 k/2

    IdealGas(scalar restDensity, scalar c) : stiffness(restDensity * c * c) {}

    HOST_DEVICE scalar pressure(scalar D) const { return stiffness * (D - 1); }
    HOST_DEVICE scalar share(scalar p, scalar D, scalar otherD) const { return p / (D * otherD); }
};

const PressureTable::Add<CompressiblePressure<IdealGas>> registered{"idealGas", "pressure in proportion to the density (Mueller, Charypar and Gross 2003)"};

}

}
