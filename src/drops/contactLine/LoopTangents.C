// SPDX-License-Identifier: GPL-3.0-or-later
#include "drops/contactLine/LoopTangents.H"

#include "core/angles/Degrees.H"
#include "drops/contactLine/LoopFrame.H"
#include "meshes/BallFit.H"

#include <algorithm>
#include <numbers>
#include <optional>

namespace shizuku
{

namespace
{

constexpr double pi = std::numbers::pi;
constexpr double sector = pi/6;             // half width, radians
constexpr int tangentsOfALoop = 36;

double wrapped(double angle) { return std::remainder(angle, 2*pi); }

struct SurfacePoint
{
    Cylindrical at;
    double area;
    SmallVector<2> normal;      // along r and z, outward
};

// The surface beside one loop.
class LoopTangents
{
public:
    LoopTangents
    (
        const TriangleMesh& drop, const std::vector<double>& height, const Loop& loop, const WallShape& wall,
        double above, double spacing
    )
    : wall_(wall), spacing_(spacing), frame_(loop, wall), outline_(loop, frame_)
    {
        collect(drop, height, above);
        chooseShape();
    }

    std::vector<LineTangent> tangents() const
    {
        std::vector<LineTangent> result;
        if (!shape_) return result;
        for (int i = 0; i < tangentsOfALoop; ++i)
        {
            const double azimuth = 2*pi*i/tangentsOfALoop;
            const auto fit = fitSector(azimuth, *shape_);
            if (!fit) continue;
            if (const auto tangent = follow(azimuth, *shape_, fit->coefficients)) result.push_back(*tangent);
        }
        const std::size_t n = result.size();
        for (std::size_t i = 0; i < n; ++i)
        {
            const Vector3& p = result[i].point;
            result[i].length = 0.5*(length(result[(i + 1) % n].point - p) + length(p - result[(i + n - 1) % n].point));
        }
        return result;
    }

private:
    static constexpr std::size_t terms = 8;     // 1 s s^2 s^3 a a s a^2 a^2 s
    static constexpr int maxDegree = 3;
    using Coefficients = SmallVector<terms>;

    // The circle that the surface is described by, and how it may depart from it.
    struct Shape
    {
        BallFit<2> circle;
        double start = 0;           // polar angle of the loop on the circle
        int towardsWall = 1;        // sign of the polar angle's change on the way to the wall
        bool convex = true;         // the liquid is on the inner side of the circle
        int degree = 0;
    };

    struct SectorFit
    {
        Coefficients coefficients;
        double squares = 0, weights = 0;
    };

    void collect(const TriangleMesh& drop, const std::vector<double>& height, double above)
    {
        std::vector<Vector3> normals(drop.vertices.size());
        for (const auto& [i, j, k] : drop.faces)
        {
            const Vector3 area = cross(drop.vertices[j] - drop.vertices[i], drop.vertices[k] - drop.vertices[i])/6;
            for (const int corner : {i, j, k}) normals[corner] += area;
        }
        const std::vector<double> areas = drop.vertexAreas();
        for (std::size_t i = 0; i < drop.vertices.size(); ++i)
        {
            if (height[i] <= above) continue;
            const Cylindrical at = frame_.of(drop.vertices[i]);
            points_.push_back
            (
                {at, areas[i], {dot(normals[i], frame_.radial(at.azimuth)), dot(normals[i], frame_.axis())}}
            );
            apex_ = std::max(apex_, at.z - outline_.meanZ);
        }
    }

    // Radius and height as if the loop were a circle.
    SmallVector<2> onMeanMeridian(const SurfacePoint& p, const SmallVector<2>& shift) const
    {
        return {p.at.r - shift[0], p.at.z - shift[1]};
    }

    std::vector<SurfacePoint> pointsWithin(double reach) const
    {
        std::vector<SurfacePoint> near;
        for (const SurfacePoint& p : points_)
        {
            const SmallVector<2> x = onMeanMeridian(p, outline_.shift(p.at.azimuth));
            if (std::hypot(x[0] - outline_.meanR, x[1] - outline_.meanZ) <= reach) near.push_back(p);
        }
        return near;
    }

    std::optional<BallFit<2>> circleThrough(const std::vector<SurfacePoint>& points) const
    {
        std::vector<SmallVector<2>> meridian;
        std::vector<double> weights;
        for (const SurfacePoint& p : points)
        {
            meridian.push_back(onMeanMeridian(p, outline_.shift(p.at.azimuth)));
            weights.push_back(p.area);
        }
        return fitBall<2>(meridian, weights);
    }

    // The circle of the whole drop's sphere: by mirrored points its centre comes to lie on the axis.
    std::optional<BallFit<2>> sphereOfDrop() const
    {
        std::vector<SmallVector<2>> meridian;
        std::vector<double> weights;
        for (const SurfacePoint& p : points_)
        {
            for (const double r : {p.at.r, -p.at.r})
            {
                meridian.push_back({r, p.at.z});
                weights.push_back(p.area);
            }
        }
        return fitBall<2>(meridian, weights);
    }

    // How the surface next to the line lies about a circle.
    Shape shapeAbout(const BallFit<2>& circle) const
    {
        Shape shape{circle};
        shape.start = polar({outline_.meanR, outline_.meanZ}, circle);
        double ahead = 0, outward = 0;
        for (const SurfacePoint& p : points_)
        {
            const double psi = polar(onMeanMeridian(p, outline_.shift(p.at.azimuth)), circle);
            ahead += p.area*wrapped(psi - shape.start);
            outward += p.normal[0]*std::cos(psi) + p.normal[1]*std::sin(psi);
        }
        shape.towardsWall = ahead > 0 ? -1 : 1;
        shape.convex = outward > 0;
        return shape;
    }

    // The whole drop's circle, or that of the surface next to the line over a reach in proportion to its radius; and the
    // degree. By Akaike: n ln(rss/n) + 2 p, with one independent point to a square of four spacings, and the parameters of
    // as many sectors as fit around.
    void chooseShape()
    {
        const auto whole = sphereOfDrop();
        const double toApex = std::hypot(outline_.meanR, apex_), least = 4*spacing_;
        reach_ = std::max(least, 0.6*toApex);
        std::optional<BallFit<2>> local;
        for (int pass = 0; pass < 3; ++pass)
        {
            local = circleThrough(pointsWithin(reach_));
            if (!local) break;
            reach_ = std::max(least, std::min(0.65*local->radius, 0.6*toApex));
        }
        points_ = pointsWithin(reach_);

        double best = HUGE_VAL;
        const int highest = highestDegree();
        if (whole) consider(shapeAbout(*whole), 0, std::max(1, highest), best);
        // Of less than two layers the surface next to the line has no circle of its own.
        if (local && highest >= 2) consider(shapeAbout(*local), 1, highest, best);
    }

    // Layers of particles are steps of a spacing in height: a curve of degree n could bend as n of them do.
    int highestDegree() const
    {
        double climb = 0;
        for (const SurfacePoint& p : points_) climb = std::max(climb, std::abs(p.at.z - outline_.meanZ));
        return std::min(int(climb/spacing_), maxDegree);
    }

    void consider(Shape shape, int lowest, int highest, double& best)
    {
        double area = 0;
        for (const SurfacePoint& p : points_) area += p.area;
        const double independent = area/(16*spacing_*spacing_);
        for (shape.degree = lowest; shape.degree <= highest; ++shape.degree)
        {
            double squares = 0, weights = 0;
            for (int i = 0; i < tangentsOfALoop; i += 3)
            {
                const auto fit = fitSector(2*pi*i/tangentsOfALoop, shape);
                if (!fit) continue;
                squares += fit->squares;
                weights += fit->weights;
            }
            const int parameters = shape.degree + (shape.degree > 0 ? 5 : 3);
            const double criterion = independent*std::log(squares/weights) + 2*parameters*pi/sector;
            if (!(criterion < best)) continue;
            best = criterion;
            shape_ = shape;
        }
    }

    static double polar(const SmallVector<2>& x, const BallFit<2>& circle)
    {
        return std::atan2(x[1] - circle.centre[1], x[0] - circle.centre[0]);
    }

    std::optional<SectorFit> fitSector(double azimuth, const Shape& shape) const
    {
        constexpr int fewest = 12;
        const SmallVector<2> shift = outline_.shift(azimuth);
        struct Row { Coefficients basis; double value, weight; };
        std::vector<Row> rows;
        NormalEquations<terms> equations;
        for (const SurfacePoint& p : points_)
        {
            const double a = wrapped(p.at.azimuth - azimuth)/sector;
            if (std::abs(a) >= 1) continue;
            const SmallVector<2> x = onMeanMeridian(p, shift);
            const double s = shape.towardsWall*wrapped(polar(x, shape.circle) - shape.start)*shape.circle.radius/reach_;
            const double value = ballFit::distance(x, shape.circle.centre) - shape.circle.radius;
            const double weight = p.area*std::pow(1 - std::abs(a*a*a), 3);
            rows.push_back({basis(s, a, shape.degree), value, weight});
            equations.add(rows.back().basis, value, weight);
        }
        if (int(rows.size()) < fewest) return std::nullopt;
        for (std::size_t k = 0; k < terms; ++k)
        {
            if (equations.matrix[k][k] == 0) equations.matrix[k][k] = 1;        // a term that the degree leaves out
        }
        const auto solution = equations.solve();
        if (!solution) return std::nullopt;
        SectorFit fit{*solution};
        for (const Row& row : rows)
        {
            const double misfit = row.value - valueOf(*solution, row.basis);
            fit.squares += row.weight*misfit*misfit;
            fit.weights += row.weight;
        }
        return fit;
    }

    static Coefficients basis(double s, double a, int degree)
    {
        if (degree == 0) s = 0;
        return {1, s, degree > 1 ? s*s : 0, degree > 2 ? s*s*s : 0, a, a*s, a*a, a*a*s};
    }

    static double valueOf(const Coefficients& coefficients, const Coefficients& basis)
    {
        double sum = 0;
        for (std::size_t k = 0; k < terms; ++k) sum += coefficients[k]*basis[k];
        return sum;
    }

    // On the sector's middle meridian; s: arc length towards the wall, m.
    Vector3 surface(double azimuth, const Shape& shape, const Coefficients& coefficients, double s) const
    {
        const double rho = shape.circle.radius + valueOf(coefficients, basis(s/reach_, 0, maxDegree));
        const double psi = shape.start + shape.towardsWall*s/shape.circle.radius;
        const SmallVector<2> shift = outline_.shift(azimuth);
        return frame_.point
        (
            shape.circle.centre[0] + rho*std::cos(psi) + shift[0], shape.circle.centre[1] + rho*std::sin(psi) + shift[1],
            azimuth
        );
    }

    // Of the surface, outward.
    Vector3 normalAt(double azimuth, const Shape& shape, const Coefficients& coefficients, double s) const
    {
        const double ds = 1e-3*spacing_;
        const Vector3 meridian = normalized
        (
            surface(azimuth, shape, coefficients, s + ds) - surface(azimuth, shape, coefficients, s - ds)
        );
        const Vector3 around = cross(frame_.axis(), frame_.radial(azimuth));
        const double psi = shape.start + shape.towardsWall*s/shape.circle.radius;
        const Vector3 outOfCircle = std::cos(psi)*frame_.radial(azimuth) + std::sin(psi)*frame_.axis();
        Vector3 normal = cross(meridian, around);
        if (dot(normal, outOfCircle) < 0) normal = -normal;
        // By the slope along the line; nearer to the axis than a spacing azimuths say little.
        const double r = std::max(frame_.of(surface(azimuth, shape, coefficients, s)).r, spacing_);
        normal -= (coefficients[4] + coefficients[5]*s/reach_)/(sector*r)*around;
        return shape.convex ? normalized(normal) : -normalized(normal);
    }

    // Along the sector's meridian to the wall, or to the point where it comes nearest to it.
    std::optional<LineTangent> follow(double azimuth, const Shape& shape, const Coefficients& coefficients) const
    {
        const double step = 0.25*spacing_, longest = std::min(3*reach_, pi*shape.circle.radius);
        const auto gap = [&](double s) { return wall_.at(surface(azimuth, shape, coefficients, s)).distance; };
        double from = 0, to = 0, last = gap(0);
        while (to < longest && last > 0)
        {
            from = to;
            to += step;
            const double next = gap(to);
            if (next >= last) break;
            last = next;
        }
        if (last > 0.5*spacing_) return std::nullopt;
        if (last <= 0)
        {
            for (int i = 0; i < 40; ++i)
            {
                const double middle = 0.5*(from + to);
                (gap(middle) > 0 ? from : to) = middle;
            }
        }
        const Vector3 point = surface(azimuth, shape, coefficients, from);
        const Vector3 normal = normalAt(azimuth, shape, coefficients, from);
        const Vector3 wallNormal = wall_.at(point).normal;
        LineTangent tangent;
        tangent.point = point;
        // The surface leans out of the wetted area at every angle but 0 and 180 degrees.
        const Vector3 along = normal - dot(normal, wallNormal)*wallNormal;
        tangent.outward = length(along) > 0 ? normalized(along) : frame_.radial(azimuth);
        tangent.angle = degrees(std::acos(std::clamp(dot(normal, wallNormal), -1.0, 1.0)));
        return tangent;
    }

    const WallShape& wall_;
    double spacing_;                        // m
    LoopFrame frame_;
    LoopOutline outline_;
    std::vector<SurfacePoint> points_;      // within reach of the loop
    double apex_ = 0, reach_ = 0;           // m: of the drop above the loop; how far along the meridian is fitted
    std::optional<Shape> shape_;
};

}

std::vector<LineTangent> tangentsBeside
(
    const Loop& loop, const TriangleMesh& drop, const std::vector<double>& height, const WallShape& wall, double above,
    double spacing
)
{
    return LoopTangents(drop, height, loop, wall, above, spacing).tangents();
}

}
