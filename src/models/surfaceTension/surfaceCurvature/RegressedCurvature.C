// SPDX-License-Identifier: GPL-3.0-or-later
#include "models/surfaceTension/surfaceCurvature/RegressedCurvature.H"

namespace shizuku
{

namespace
{

struct OutwardNormal
{
    HalfSpaceView plane;                    // of the surface's kernel
    scalar steepest;                        // the planar |G|
    FreeSurfaceView surface;
    WallView walls;
    Span<Vec3> normal;                      // with beta; zero away from the surface

    HOST_DEVICE void operator()(int i) const
    {
        const int k = int(surface.place[i]);
        const Vec3 G = surface.gradient[k];
        const scalar slope = norm(G);
        if (!(slope > leastSlope * steepest))
        {
            normal[k] = {};
            return;
        }
        const Vec3 m = -1 / slope * G;
        scalar weight = surfaceWeight(slope / steepest);
        walls.forEachContact(i, surface.position[k], plane.h, [&](int, const WallContact& wall)
        {
            weight *= trust(1 - 2 * plane(wall.distance).density, dot(m, wall.normal));
        });
        normal[k] = withWeight(m, weight);
    }

private:
    // own: 1 - 2 w. inclination: m.n.
    HOST_DEVICE static scalar trust(scalar own, scalar inclination)
    {
        constexpr scalar upright = 2;       // the power at 90 degrees: puts lattices at walls right (TestRegressedCurvature)
        constexpr scalar least = 0.01f;     // own
        return pow(fmax(own, least), upright * (1 - inclination));
    }
};

struct TangentPlane
{
    Vec3 e, f;

    TangentPlane() = default;

    HOST_DEVICE explicit TangentPlane(Vec3 m)
    {
        const Vec3 across = cross(m, fabs(m.z) < 0.9f ? Vec3{0, 0, 1} : Vec3{1, 0, 0});
        e = 1 / fmax(norm(across), 1e-20f) * across;
        f = cross(m, e);
    }
};

// The sums of a line q = a + B t through vectors q at places t of a plane. Number: a scalar, or those of a team's lanes.
template<class Number>
struct LineSums
{
    enum { w, t1, t2, t11, t12, t22, q1, q2, t1q1, t12q, t2q2, depths, count };

    Number of[count] = {};

    template<class Any>
    HOST_DEVICE void add(Number weight, const TangentPlane& plane, Any t, Any q, Number depth)
    {
        const auto a = dot(t, plane.e), b = dot(t, plane.f), u = dot(q, plane.e), v = dot(q, plane.f);
        of[w] += weight;
        of[t1] += weight * a;
        of[t2] += weight * b;
        of[t11] += weight * a * a;
        of[t12] += weight * a * b;
        of[t22] += weight * b * b;
        of[q1] += weight * u;
        of[q2] += weight * v;
        of[t1q1] += weight * a * u;
        of[t12q] += weight * (a * v + b * u);
        of[t2q2] += weight * b * v;
        of[depths] += weight * depth;
    }
};

// The trace of B. least: added to the variances of the places, so that few of them give no steep line.
HOST_DEVICE inline scalar traceOfLine(const LineSums<scalar>& sums, scalar least)
{
    using S = LineSums<scalar>;
    const scalar one = 1 / sums.of[S::w];
    const scalar a = one * sums.of[S::t1], b = one * sums.of[S::t2], u = one * sums.of[S::q1], v = one * sums.of[S::q2];
    const scalar c11 = one * sums.of[S::t11] - a * a + least, c22 = one * sums.of[S::t22] - b * b + least;
    const scalar c12 = one * sums.of[S::t12] - a * b;
    const scalar x11 = one * sums.of[S::t1q1] - a * u, x22 = one * sums.of[S::t2q2] - b * v;
    const scalar x12 = one * sums.of[S::t12q] - a * v - b * u;
    return (c22 * x11 - c12 * x12 + c11 * x22) / fmax(c11 * c22 - c12 * c12, least * least);
}

template<class Search>
struct Regress : CurvatureSums
{
    Search near;                            // among positions with depths

    HOST_DEVICE void operator()(Group places, Team team) const
    {
        const SurfaceGroup group(places, normal, near);
        TangentPlane plane[Group::most];
        LineSums<Team::Scalar> sums[Group::most];
        #pragma unroll
        for (int p = 0; p < Group::most; ++p) plane[p] = TangentPlane(group.normal[p]);
        near.forEach(group.members, [&](auto l) { return normal[l]; }, [&](int p, auto other, auto r)
        {
            const auto same = onSameSurface(group.normal[p], other);
            if (noneOf(same)) return;
            const auto mean = group.normal[p] + other;
            const auto across = same ? dot(r, mean) / squared(mean) : 0;
            sums[p].add(same ? volume * weightBeside(other) * W.W(norm(r)) : 0, plane[p], across * mean - r, other, 0.5f * (group.depth[p] + depthBeside(r)));
        }, team);
        LineSums<scalar> all;
        #pragma unroll
        for (int n = 0; n < LineSums<scalar>::count; ++n)
        {
            Team::Scalar parts[Group::most];
            #pragma unroll
            for (int p = 0; p < Group::most; ++p) parts[p] = sums[p].of[n];
            all.of[n] = team.sums(parts);
        }
        if (group.has(team.lane)) finish(places.first + team.lane, all);
        else if (team.lane < places.size) curvature[places.first + team.lane] = 0;
    }

private:
    // Adds the particle itself and the walls' part.
    HOST_DEVICE void finish(int k, LineSums<scalar> sums) const
    {
        const int i = int(selected[k]);
        const Position xi = near.points[k];
        const Vec3 mi = normal[k];
        const TangentPlane plane(mi);
        sums.add(volume * weightBeside(mi) * W.W(0), plane, Vec3{}, mi, surface.depthOf(k));
        const ContactLine line = surface.contactAt(k);
        walls.forEachContact(i, xi, W.h, [&](int a, const WallContact& wall)
        {
            if (a != line.wall) return;
            const scalar sine = sin(line.theta), cosine = cos(line.theta);
            const Vec3 m = sine * line.tangent + cosine * wall.normal, mean = mi + m;
            const scalar inclined = cosine > 0 ? fmax(sine, dot(mi, line.tangent)) : sine;
            const Vec3 r = -fmax(fromContactLine(wall.distance, line, inclined), 0) * alongFromLine(wall, line);
            const Vec3 t = r - dot(r, mean) / fmax(squared(mean), 1e-6f) * mean;
            sums.add(extended(line.theta, wall.distance / W.h, line.depth / W.h).value, plane, t, m, surface.depthOf(k));
        });
        constexpr scalar leastVariance = 1e-4f;         // in supports squared
        const scalar kappa = fmin(fmax(traceOfLine(sums, leastVariance * W.h * W.h), -largest), largest);
        curvature[k] = broughtUp(kappa, sums.of[sums.depths] / sums.of[sums.w]);
    }
};

}

RegressedCurvature::RegressedCurvature(const Dictionary& coeffs, const Liquid& liquid, FreeSurface& surface, scalar sigma)
:
    SurfaceCurvature(coeffs, liquid, surface, sigma, WedgePart::ahead)
{}

CurvatureField RegressedCurvature::normals(const Liquid& liquid, const Neighbourhood&, const Walls& walls)
{
    CurvatureField field = makeField();
    forEach(surface_.particles(), OutwardNormal{surface_.plane(), surface_.steepest(), surface_.view(), walls.view(liquid), field.normal.span()});
    return field;
}

Columns RegressedCurvature::read(CurvatureField& field) const
{
    return {surface_.positions(), valuesOf(surface_.particles(), field.normal)};
}

void RegressedCurvature::curvatures(CurvatureField& field, const Liquid& liquid, const Neighbourhood& near, const Walls& walls)
{
    findCurvatures(field, liquid, near, walls, [&]<class Search>(const CurvatureSums& sums, const Search& among)
    {
        forEachGroup(surface_.particles(), Regress<Search>{sums, among});
    });
}

}
