// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/foot/LatticeLiquid.H"

namespace shizuku
{

LatticeLiquid::LatticeLiquid(const std::vector<Vector3>& particles, double spacing)
: particles_(particles), spacing_(spacing), grid_(1.5*spacing, particles)
{
    constexpr std::size_t most = 400;
    const std::size_t stride = particles.size()/most + 1;
    int sampled = 0, standing = 0;
    for (std::size_t i = 0; i < particles.size(); i += stride, ++sampled) standing += isOnLattice(int(i));
    any_ = 20*standing > sampled;
}

bool LatticeLiquid::at(const Vector3& x) const
{
    int near = 0, standing = 0;
    grid_.forEachWithin(x, 1.5*spacing_, [&](int i, double)
    {
        ++near;
        standing += isOnLattice(i);
    });
    return 2*standing > near;
}

bool LatticeLiquid::isOnLattice(int particle) const
{
    constexpr double exact = 0.01, least = (1 - exact)*(1 - exact);
    int apart = 0;
    grid_.forEachWithin(particles_[particle], (1 + exact)*spacing_, [&](int, double d2) { apart += d2 >= least*spacing_*spacing_; });
    return apart >= 3;
}

}
