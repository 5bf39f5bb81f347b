// SPDX-License-Identifier: GPL-3.0-or-later
#include "freeSurface/ExtendedLiquid.H"

#include "device/Device.H"
#include "device/ForEach.H"
#include "maths/EvenTable.H"

#include <cmath>

namespace shizuku
{

namespace
{

constexpr double degree = 3.14159265358979323846 / 180;

// Integrals of the kernel along the contact line's direction, over the distance from that line's plane of symmetry.
struct Marginal
{
    scalar value, slope;            // of W, of W'/r
};

struct MarginalView
{
    Span<const Marginal> table;

    HOST_DEVICE Marginal operator()(scalar distance) const
    {
        const scalar x = distance * scalar(table.size - 1);
        const int i = int(x);
        if (i >= table.size - 1) return {0, 0};
        const scalar f = x - scalar(i);
        const Marginal a = table[i], b = table[i + 1];
        return {a.value + f * (b.value - a.value), a.slope + f * (b.slope - a.slope)};
    }
};

std::vector<Marginal> tabulateMarginals(const KernelChoice& kernel)
{
    constexpr int n = 512, parts = 200;
    const scalar h = supportOf(kernel);
    std::vector<Marginal> table(n + 1);
    std::visit
    (
        [&](const auto& W)
        {
            for (int i = 0; i <= n; ++i)
            {
                const double x = double(i) / n, length = std::sqrt(1 - x * x);
                double value = 0, slope = 0;
                for (int k = 0; k < parts; ++k)
                {
                    const double y = length * (k + 0.5) / parts, r = std::sqrt(x * x + y * y);
                    // Of the kernel with support 1.
                    value += W.W(scalar(r * h)) * h * h * h;
                    slope += W.g(scalar(r * h)) * h * h * h * h * h;
                }
                table[i] = {scalar(2 * length / parts * value), scalar(2 * length / parts * slope)};
            }
        },
        kernel
    );
    return table;
}

struct Integrate
{
    MarginalView marginal;
    scalar firstAngle, angleStep;
    Span<const scalar> weight;
    WedgePart part;
    Span<WedgeIntegrals> table;

    HOST_DEVICE void operator()(int entry) const
    {
        using View = ExtendedLiquidView;
        const int b = entry % (View::depths + 1), a = entry / (View::depths + 1) % (View::distances + 1);
        const scalar theta = firstAngle + angleStep * scalar(entry / (View::depths + 1) / (View::distances + 1));
        const scalar z = scalar(a) / View::distances, s = 2 * scalar(b) / View::depths - 1;
        const scalar sine = sin(theta), cosine = cos(theta);

        // y - x = along t + below n; sums over below = -1 ... -z, and over what of `along` is inside of the wedge.
        constexpr int n = 48;
        double value = 0, tangential = 0, normal = 0;
        for (int i = 0; i < n; ++i)
        {
            const scalar below = -z - (1 - z) * (scalar(i) + 0.5f) / n;
            const scalar reach = sqrt(fmax(1 - below * below, 0));
            const scalar depth = s - below * cosine;    // of the point at along = 0
            const scalar from = -reach;
            scalar to = reach;
            if (sine > 1e-3f) to = fmin(to, depth / sine);
            else if (depth < 0) continue;
            if (from >= to) continue;
            const scalar area = (1 - z) / n * (to - from) / n;
            for (int j = 0; j < n; ++j)
            {
                const scalar along = from + (to - from) * (scalar(j) + 0.5f) / n;
                if (part == WedgePart::ahead && cosine * along <= sine * below) continue;
                const Marginal m = marginal(sqrt(along * along + below * below));
                const scalar share = valueAt(weight, depth - along * sine) * area;
                value += m.value * share;
                tangential -= m.slope * along * share;
                normal -= m.slope * below * share;
            }
        }
        table[entry] = {scalar(value), scalar(tangential), scalar(normal)};
    }
};

}

ExtendedLiquid::ExtendedLiquid
(
    const KernelChoice& kernel, std::pair<double, double> theta, const std::vector<scalar>& weight, WedgePart part
)
{
    const auto [smallestTheta, largestTheta] = theta;
    constexpr double widest = 5;
    const int steps = int(std::ceil((largestTheta - smallestTheta) / widest - 1e-6));
    angles_ = steps + 1;
    firstAngle_ = scalar(smallestTheta * degree);
    angleStep_ = steps > 0 ? scalar((largestTheta - smallestTheta) * degree / steps) : 1;

    const Buffer<Marginal> marginals(tabulateMarginals(kernel));
    const Buffer<scalar> weights(weight);
    table_.resize(angles_ * (ExtendedLiquidView::distances + 1) * (ExtendedLiquidView::depths + 1));
    forEach(table_.size(), Integrate{{marginals.span()}, firstAngle_, angleStep_, weights.span(), part, table_.span()});
    synchronize();                          // marginals and weights go out of scope
}

ExtendedLiquidView ExtendedLiquid::view() const
{
    return {table_.span(), angles_, firstAngle_, angleStep_};
}

}
