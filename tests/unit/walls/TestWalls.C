// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/Walls.H"

#include "support/LiquidCase.H"
#include "support/ReferenceKernels.H"

using namespace shizuku;
using namespace shizuku::test;

namespace
{

std::string refusalOf(const CaseText& text)
{
    return messageOf([&] { LiquidCase{text}; });
}

// Of each liquid particle the tangent plane, where the particle is, and which of those that were placed it is.
struct FittedPlanes
{
    std::vector<Vec3> normal, point, x;
    std::vector<std::uint32_t> id;
};

FittedPlanes fittedPlanes(const LiquidCase& drop)
{
    const auto view = drop.walls.view(drop.liquid).planes;
    return {download(view.normal), download(view.point), vectors(drop.liquid.predicted), drop.liquid.id.download()};
}

}

// Equation (9) by direct sums over the whole layer, its rim included. Float distances and sums: a few 1e-6 at the steep
// flank.
TEST(Walls, GiveSolidParticlesTheirVirtualVolumes)
{
    for (const bool isSpline : {true, false})
    {
        const std::string kernel = isSpline ? "type cubicSpline; support 2;" : "type poly6Spiky; support 2.5;";
        const auto layer = latticeBlock(15, 13, 1, 0.9f, {-7, -6, -0.5f});
        const LiquidCase walls({.kernel = kernel, .walls = sampledFloor, .solidPositions = layer});
        const double d = walls.liquid.spacing(), h = walls.liquid.support();
        const auto view = walls.walls.view(walls.liquid).particles;
        const auto position = download(view.position);
        const auto volume = download(view.volume);
        ASSERT_EQ(volume.size(), layer.size());
        EXPECT_EQ(walls.walls.particles(), 195);
        for (std::size_t k = 0; k < volume.size(); ++k)
        {
            double sum = 0;
            for (const Vec3& l : layer)
            {
                const double r = std::hypot(position[k].x - d * l.x, position[k].y - d * l.y, position[k].z - d * l.z);
                sum += isSpline ? Reference<CubicSpline>{h}.W(r) : Reference<Poly6Spiky>{h}.W(r);
            }
            ASSERT_NEAR(volume[k] * sum, 1, 5e-6) << k;
        }
    }
}

TEST(Walls, ReorderContactAnglesWithTheirParticles)
{
    const auto layer = randomPoints(50, {-5, -5, -0.5f}, {5, 5, -0.4f});
    std::vector<double> theta;
    for (const Vec3& p : layer) theta.push_back(90 + 10 * p.x);
    LiquidCase walls({.walls = sampledFloor, .solidPositions = layer, .solidTheta = theta});
    EXPECT_EQ(walls.walls.view(walls.liquid).particles.cosTheta.size, 0);       // nobody asked
    walls.useWalls();
    const auto view = walls.walls.view(walls.liquid).particles;
    const auto position = download(view.position);
    const auto cosine = download(view.cosTheta);
    ASSERT_EQ(cosine.size(), 50u);
    for (int k = 0; k < 50; ++k)
    {
        const double degrees = 90 + 10 * position[k].x / walls.liquid.spacing();
        EXPECT_NEAR(cosine[k], std::cos(degrees * std::numbers::pi / 180), 1e-6);       // single precision of an angle
    }
}

// Contact angles belong to their particles however often these are sorted: into the cells of a wider search too.
TEST(Walls, KeepContactAnglesWithTheirParticlesInWiderCells)
{
    const auto layer = randomPoints(300, {-8, -8, -0.5f}, {8, 8, -0.4f});
    std::vector<double> theta;
    for (const Vec3& p : layer) theta.push_back(90 + 10 * p.x);
    for (const bool anglesFirst : {true, false})
    {
        LiquidCase walls({.walls = sampledFloor, .solidPositions = layer, .solidTheta = theta});
        if (anglesFirst) walls.useWalls();
        walls.useWalls(4 * walls.liquid.spacing());
        walls.useWalls();
        const auto view = walls.walls.view(walls.liquid).particles;
        const auto position = download(view.position);
        const auto cosine = download(view.cosTheta);
        ASSERT_EQ(cosine.size(), layer.size());
        const auto cosineOf = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180); };
        for (std::size_t k = 0; k < layer.size(); ++k)
        {
            // Single precision of an angle.
            ASSERT_NEAR(cosine[k], cosineOf(90 + 10 * position[k].x / walls.liquid.spacing()), 1e-6);
        }
        // In the order of the file again.
        ASSERT_TRUE(walls.walls.angles().has_value());
        EXPECT_EQ(walls.walls.angles()->particles, theta);
    }
}

TEST(Walls, TellTheirSmallestAndLargestContactAngle)
{
    const std::string plane = "side { type plane; point (-8e-3 0 0); normal (1 0 0); }";
    const std::string ball = "ball { type sphere; centre (0 0 20e-3); radius 5e-3; liquid outside; }";
    const std::pair<double, double> right{90, 90};
    const auto anglesOf = [&](LiquidCase& walls)
    {
        EXPECT_EQ(walls.walls.contactAngles(), right);          // nobody asked
        walls.useWalls();
        return walls.walls.contactAngles();
    };
    // Single precision of a cosine, over the sine of at least 0.5: 1e-5 degrees.
    LiquidCase analytic({.walls = plane + ball, .wettability = "side { theta 30; } ball { theta 110; }"});
    const auto ofAnalytic = anglesOf(analytic);
    EXPECT_NEAR(ofAnalytic.first, 30, 2e-5);
    EXPECT_NEAR(ofAnalytic.second, 110, 2e-5);

    const std::vector<Vec3> layer{{0, 0, -0.5f}, {1, 0, -0.5f}, {0, 1, -0.5f}};
    LiquidCase both({.walls = plane + sampledFloor, .wettability = "side { theta 75; }", .solidPositions = layer,
                     .solidTheta = {90, 150, 40}});
    const auto ofBoth = anglesOf(both);
    EXPECT_NEAR(ofBoth.first, 40, 2e-5);
    EXPECT_NEAR(ofBoth.second, 150, 2e-5);

    LiquidCase none;
    EXPECT_EQ(anglesOf(none), right);
}

// The tangent plane of a flat layer is the solid's surface, half a spacing before it, wherever the layer is and however it
// lies; its contact angle is the mean of the patch. Coordinates of up to ten units: 2e-6. Beside the border there is none.
TEST(Walls, FitThePlaneOfAFlatLayer)
{
    for (const double tilt : {0.0, 17.0, 45.0})
    {
        for (const scalar apart : {1.0f, 0.83f})
        {
            const scalar sine = scalar(std::sin(tilt * std::numbers::pi / 180)), cosine = std::sqrt(1 - sine * sine);
            // The layer's coordinates a, b and the height above the surface.
            const auto place = [&](Vec3 p) { return Vec3{p.x * cosine - p.z * sine, p.y, p.x * sine + p.z * cosine + 2}; };
            std::vector<Vec3> layer = latticeBlock(15, 15, 1, apart, {-7 * apart, -7 * apart, -0.5f}), points;
            for (Vec3& p : layer) p = place(p);
            const Vec3 n = place({0, 0, 1}) - place({});
            LiquidCase drop({.walls = sampledFloor, .solidPositions = layer, .solidNormal = n,
                             .solidTheta = std::vector<double>(layer.size(), 60)});
            drop.useWalls();
            drop.useWalls(4 * drop.liquid.spacing());
            const auto local = randomPoints(60, {-4, -4, 0.3f}, {4, 4, 3.9f});
            for (const Vec3& p : local) points.push_back(place(p));
            points.push_back(place({7 * apart + 3, 0, 0.5f}));
            drop.place(points);

            const scalar d = drop.liquid.spacing();
            const auto [normal, point, x, id] = fittedPlanes(drop);
            ASSERT_EQ(point.size(), points.size());
            for (std::size_t i = 0; i < points.size(); ++i)
            {
                if (id[i] == 60)
                {
                    EXPECT_EQ(norm(normal[i]), 0);
                    continue;
                }
                EXPECT_NEAR(norm(normal[i] - n), 0, 1e-6);
                EXPECT_NEAR(dot(normal[i], x[i] - point[i]), local[id[i]].z * d, 4e-6) << tilt << " " << apart;
                EXPECT_NEAR(normal[i].w, 0.5f, 1e-6);
            }
        }
    }
}

// On a sampled sphere, wherever it is: the distance to the tangent plane is that to the sphere. Some twelve particles give
// the normal to a degree, which takes (R + s)(1 - cos 1 degree), below 0.003 spacings, off the distance.
TEST(Walls, FitTangentPlanesToASampledSphere)
{
    for (const scalar radius : {6.0f, 12.0f})
    {
        for (const Vec3 centre : {Vec3{}, Vec3{60, -40, 25}})
        {
            const auto onSphere = [](int n)
            {
                std::vector<Vec3> directions;
                for (int k = 0; k < n; ++k)                 // a Fibonacci lattice
                {
                    const double z = 1 - (2 * k + 1.0) / n, r = std::sqrt(1 - z * z);
                    const double turn = k * std::numbers::pi * (3 - std::sqrt(5));
                    directions.push_back({scalar(r * std::cos(turn)), scalar(r * std::sin(turn)), scalar(z)});
                }
                return directions;
            };
            const scalar layer = radius - 0.5f;
            const auto normals = onSphere(int(4 * std::numbers::pi * layer * layer));
            std::vector<Vec3> solid, points;
            for (const Vec3& n : normals) solid.push_back(centre + layer * n);
            const auto directions = onSphere(100);
            RandomNumbers random(5);
            for (const Vec3& e : directions) points.push_back(centre + (radius + random(0.3f, 3.9f)) * e);
            LiquidCase drop({.walls = sampledFloor, .solidPositions = solid, .solidNormals = normals});
            drop.useWalls(4 * drop.liquid.spacing());
            drop.place(points);

            const scalar d = drop.liquid.spacing();
            const auto [normal, point, x, id] = fittedPlanes(drop);
            for (std::size_t i = 0; i < points.size(); ++i)
            {
                const scalar distance = norm(points[id[i]] - centre) - radius;
                EXPECT_GT(dot(normal[i], directions[id[i]]), std::cos(std::numbers::pi / 180)) << distance;
                EXPECT_NEAR(dot(normal[i], x[i] - point[i]) / d, distance, 0.003f) << radius << " " << distance;
            }
        }
    }
}

// With tangent planes, liquid goes back to half a spacing before the sampled surface, as before an analytic one; hardly farther than it was before the step.
TEST(Walls, PutLiquidBackHalfASpacingBeforeATangentPlane)
{
    LiquidCase drop({.walls = sampledFloor, .solidPositions = latticeBlock(15, 15, 1, 1, {-7, -7, -0.5f})});
    drop.useWalls(4 * drop.liquid.spacing());
    drop.place({{0.3f, 0.2f, 0.1f}, {-2, 1.5f, 0.7f}, {2, 1.5f, 0.1f}});
    const scalar d = drop.liquid.spacing();
    auto before = vectors(drop.liquid.position);
    for (Vec3& x : before) x.z = x.x > d ? 0.3f * d : d;
    drop.liquid.position.upload(placed(before));
    drop.walls.project(drop.liquid);
    const auto moved = drop.inOrder(drop.liquid.predicted);
    EXPECT_NEAR(moved[0].z, 0.5f * d, 2 * quanta::each);
    EXPECT_EQ(moved[1].z, rounded(0.7f * d));
    EXPECT_NEAR(moved[2].z, 0.32f * d, 2 * quanta::each);
}

TEST(Walls, PutLiquidBackHalfASpacingOutside)
{
    LiquidCase drop({.walls = floorPlane +
                              "ball { type sphere; centre (0 0 0); radius 5e-3; liquid inside; }"});
    drop.place({{0, 0, 0.2f}, {1, 0, -0.7f}, {0, 1, 3}, {0, 0, 4.9f}});
    drop.walls.project(drop.liquid);
    const auto moved = drop.inOrder(drop.liquid.predicted);
    const scalar d = drop.liquid.spacing();
    // Places are rounded to 1e-6, before and behind.
    EXPECT_NEAR(moved[0].z, 0.5f * d, 2 * quanta::each);
    EXPECT_NEAR(moved[1].z, 0.5f * d, 2 * quanta::each);
    EXPECT_EQ(moved[1].x, rounded(d));
    EXPECT_EQ(moved[2].z, rounded(3 * d));
    EXPECT_NEAR(moved[3].z, 4.5f * d, 2 * quanta::each);
}

TEST(Walls, StopLiquidAQuarterOfASpacingBeforeALayer)
{
    LiquidCase drop({.walls = sampledFloor, .solidPositions = latticeBlock(9, 9, 1, 1, {-4, -4, -0.5f})});
    // Before the layer, too near to it, behind it, beside its border at 4 spacings, and too near to it before the step.
    drop.place({{0.3f, 0.2f, -0.24f}, {-2, 1.5f, -0.4f}, {2.1f, -1.2f, -0.9f}, {5.2f, 0, -0.9f}, {0, 2, -0.4f}});
    const scalar d = drop.liquid.spacing();
    auto before = vectors(drop.liquid.position);
    for (Vec3& x : before) x.z = x.x == 0 ? -0.35f * d : 0;
    drop.liquid.position.upload(placed(before));
    drop.walls.project(drop.liquid);
    const auto moved = drop.inOrder(drop.liquid.predicted);
    EXPECT_EQ(moved[0].z, rounded(-0.24f * d));
    // Averages of equal heights; places are rounded to 1e-6.
    EXPECT_NEAR(moved[1].z, -0.25f * d, 2 * quanta::each);
    EXPECT_NEAR(moved[2].z, -0.25f * d, 2 * quanta::each);
    EXPECT_EQ(moved[2].x, rounded(2.1f * d));
    EXPECT_EQ(moved[3].z, rounded(-0.9f * d));
    EXPECT_NEAR(moved[4].z, -0.35f * d, 2 * quanta::each);
}

TEST(Walls, HaveNoInnerSideWhereNormalsCancel)
{
    LiquidCase drop({.walls = sampledFloor, .solidPositions = latticeBlock(9, 9, 1, 1, {-4, -4, -0.5f}), .solidNormal = {}});
    drop.place({{0, 0, -0.4f}});
    drop.liquid.position.upload(placed(std::vector<Vec3>{{0, 0, 0}}));
    drop.walls.project(drop.liquid);
    EXPECT_EQ(drop.inOrder(drop.liquid.predicted)[0].z, rounded(-0.4f * drop.liquid.spacing()));
}

TEST(Walls, RefuseLiquidThatStartsInTheSolid)
{
    LiquidCase drop({.walls = floorPlane});
    drop.place({{0, 0, 0.26f}, {2, 0, 3}});
    const auto check = [&] { drop.walls.refuseLiquidInside(drop.liquid); };
    EXPECT_EQ(messageOf(check), "no error");
    drop.place({{0, 0, 0.5f}, {2, 0, 0.24f}});
    EXPECT_TRUE(holds(messageOf(check), {"constant/walls", "floor", "0.0002"}));
}

// A plane holds across, two of them leave the line they share, a sphere leaves nothing; the same plane twice is one.
TEST(Walls, TellInWhichDirectionsTheyHold)
{
    const auto freePart = [](const std::string& walls)
    {
        const LiquidCase liquid({.walls = walls});
        return liquid.walls.constraints().freePart({1, 2, 3});
    };
    const auto expect = [](Vec3 found, Vec3 wanted) { EXPECT_LT(norm(found - wanted), 1e-6f); };
    const std::string floor = "floor { type plane; point (0 0 -1); normal (0 0 1); }\n";
    expect(freePart(""), {1, 2, 3});
    expect(freePart(floor), {1, 2, 0});
    expect(freePart(floor + "lid { type plane; point (0 0 1); normal (0 0 -1); }"), {1, 2, 0});
    expect(freePart(floor + "side { type plane; point (-1 0 0); normal (1 0 1); }"), {0, 2, 0});
    expect(freePart("ball { type sphere; centre (0 0 -1); radius 0.1; liquid outside; }"), {0, 0, 0});
}

TEST(Walls, CountABoxAsSixSurfaces)
{
    const LiquidCase tank({.walls = "tank { type box; min (0 0 0); max (1 2 3); }"});
    EXPECT_EQ(tank.walls.surfaces(), 6);
    EXPECT_EQ(tank.walls.particles(), 0);
    const auto view = tank.walls.view(tank.liquid).surfaces;
    const scalar unit = scalar(tank.liquid.units().length);
    const Place inside = placeAt(0.5 / unit, 0.5 / unit, 2 / unit);
    scalar nearest = 1e9f, sum = 0;
    for (int a = 0; a < view.count; ++a)
    {
        nearest = std::min(nearest, view[a](inside).distance * unit);
        sum += view[a](inside).distance * unit;
    }
    EXPECT_NEAR(nearest, 0.5f, 1e-6);
    EXPECT_NEAR(sum, 6, 1e-5);          // the box's three edges together
}

namespace
{

struct DensityOf
{
    WallView walls;
    Span<const Position> at;
    Span<scalar> sum;
    Span<int> near;

    HOST_DEVICE void operator()(int i) const
    {
        sum[i] = walls.ofSurfaces(i, at[i]).value;
        near[i] = 0;
        walls.forEachContact(i, at[i], 1e9f, [&](int a, const WallContact&) { near[i] += a + 1; });
    }
};

// A floor listed behind `others` planes that are too far away to act.
CaseText floorBehind(int others)
{
    std::string walls;
    for (int a = 0; a < others; ++a) walls += "far" + std::to_string(a) + " { type plane; point (" + std::to_string(-1 - a) + " 0 0); normal (1 0 0); }\n";
    return {.walls = walls + "floor { type plane; point (0 0 0); normal (0 0 1); }"};
}

}

// Surfaces beyond the kernel's arguments act like the first twelve. The floor is the last one.
TEST(Walls, AreAnyNumberOfSurfaces)
{
    std::vector<std::vector<scalar>> densities;
    for (const int others : {0, WallSurfacesView::few - 1, WallSurfacesView::few, 40})
    {
        LiquidCase drop(floorBehind(others));
        drop.place({{0, 0, 0.5f}, {0, 0, 1}, {2, 0, 1.5f}});
        ASSERT_EQ(drop.walls.surfaces(), others + 1);
        Buffer<scalar> sum(3);
        Buffer<int> near(3);
        forEach(3, DensityOf{drop.walls.view(drop.liquid), drop.liquid.predicted.span(), sum.span(), near.span()});
        densities.push_back(drop.inOrder(sum));
        EXPECT_EQ(densities.back(), densities.front()) << others;
        EXPECT_EQ(near.download(), std::vector<int>(3, (others + 1) * (others + 2) / 2)) << others;      // each surface once
    }
    EXPECT_GT(densities.front()[0], densities.front()[1]);
}

TEST(Walls, RefuseWhatIsMissing)
{
    EXPECT_TRUE(holds(refusalOf({.walls = sampledFloor}), {"constant/walls", "solid/positions", "sampleSurface"}));
    EXPECT_TRUE(holds(refusalOf({.walls = "floor { type plan; }"}), {"constant/walls", "plan", "plane"}));

    LiquidCase noAngles({.walls = sampledFloor, .solidPositions = {{0, 0, 0}}});
    EXPECT_TRUE(holds(messageOf([&] { noAngles.walls.readAngles(); }), {"solid/theta", "sampleTheta"}));
}

TEST(Walls, ReadContactAnglesOfSurfaces)
{
    for (const auto& [theta, cosine] : {std::pair{"0", 1.0}, {"60", 0.5}, {"180", -1.0}})
    {
        LiquidCase drop({.walls = floorPlane, .wettability = "floor { theta " + std::string(theta) + "; }"});
        drop.useWalls();
        EXPECT_NEAR(drop.walls.view(drop.liquid).surfaces.surface[0].cosTheta, cosine, 1e-7);
    }
    LiquidCase wrong({.walls = floorPlane, .wettability = "floor { theta 181; }"});
    EXPECT_TRUE(holds(messageOf([&] { wrong.walls.readAngles(); }),
                      {"constant/wettability", "181", "0 to 180"}));
}
