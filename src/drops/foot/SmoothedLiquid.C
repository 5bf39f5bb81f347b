// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/foot/SmoothedLiquid.H"

#include "maths/Lattice.H"

namespace shizuku
{

SmoothedLiquid::SmoothedLiquid(const std::vector<Vector3>& particles, double spacing, double support)
:
    particles_(particles), spacing_(spacing), W_(scalar(support/spacing)),
    volume_(1/latticeSum(1, W_.h, [this](scalar r) { return W_.W(r); })), grid_(support, particles)
{}

double SmoothedLiquid::at(const Vector3& x, Vector3& gradient) const
{
    double sum = 0;
    Vector3 slope;
    grid_.forEachWithin(x, W_.h*spacing_, [&](int j, double)
    {
        const Vector3 r = (x - particles_[j])/spacing_;
        const scalar distance = scalar(length(r));
        sum += W_.W(distance);
        slope += W_.g(distance)*r;
    });
    gradient = volume_/spacing_*slope;
    return volume_*sum;
}

}
