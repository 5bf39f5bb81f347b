// SPDX-License-Identifier: GPL-3.0-or-later
// Ghosts get what a model declares to read of neighbours, of its verb and of each inner loop, and where what is not declared is poisoned a wrong declaration shows. TestParts runs all
// models so.

#include "particles/NeighbourLoop.H"
#include "stepping/SubStep.H"
#include "support/LiquidCase.H"

#include <cmath>
#include <functional>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

// XSPH, which reads positions and velocities of neighbours, with a declaration of its own.
class Declares : public Viscosity
{
public:
    using Reads = std::function<Columns(Liquid&)>;

    Declares(Liquid& liquid, Reads reads) : smoothing_(Viscosity::New(Dictionary::parse("viscosity XSPH; XSPHCoeffs { c 0.5; }"), liquid)), reads_(std::move(reads)) {}

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override { return reads_(liquid); }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls& walls, scalar dt) override { smoothing_->apply(liquid, near, walls, dt); }

private:
    std::unique_ptr<Viscosity> smoothing_;
    Reads reads_;
};

struct AddNeighbours
{
    scalar support;
    Span<const Position> x;
    Span<const Vec3> of;
    NeighbourView near;
    Span<Vec3> sum;

    HOST_DEVICE void operator()(int i) const
    {
        Vec3 all = of[i];
        near.forEach(i, [&](int j) { all += fmax(1 - norm(x[i] - x[j]) / support, 0) * of[j]; });
        sum[i] = all;
    }
};

// Sums over neighbours of sums over neighbours: two loops, the second with a declaration of its own. In between a loop that reads nothing.
class AddsTwice : public Viscosity
{
public:
    // What the second loop reads, the sums and positions.
    struct Reads
    {
        bool changed, kept;
    };

    AddsTwice(Liquid& liquid, Reads reads)
    :
        reads_(reads), sum_(liquid.fields().require<Vec3>({.name = "sum", .dimensions = dimensions::velocity, .sorted = false}))
    {}

    std::optional<Columns> readsOfNeighbours(Liquid& liquid) const override { return Columns{valuesOf(liquid.position), valuesOf(liquid.velocity)}; }

    void apply(Liquid& liquid, const Neighbourhood& near, const Walls&, scalar) override
    {
        const auto positions = std::as_const(liquid.position).span();
        NeighbourLoop(liquid).forEach(AddNeighbours{liquid.support(), positions, liquid.velocity.span(), near.view(), sum_.span()});
        NeighbourLoop(liquid).run([] {});
        NeighbourLoop(liquid, {when(reads_.changed, valuesOf(sum_))}, {when(reads_.kept, valuesOf(liquid.position))}).forEach(AddNeighbours
        {
            liquid.support(), positions, std::as_const(sum_).span(), near.view(), liquid.velocity.span()
        });
    }

private:
    Reads reads_;
    Buffer<Vec3>& sum_;
};

constexpr int period = 8;                               // spacings

using MakeViscosity = std::function<std::unique_ptr<Viscosity>(Liquid&)>;

// The velocities after a step of liquid that fills a space which repeats along x. Particles fly freely, but for the viscosity.
std::vector<Vec3> velocitiesAfter(const MakeViscosity& viscosity, bool poison)
{
    LiquidCase box({.boundary = "min (-4e-3 -1 -1); max (4e-3 1 1); sides { xMin cyclic; xMax cyclic; }"});
    box.folder.write("constant/models", "pressure none; surfaceTension none; wetting none; viscosity none; bodyForce none;");
    Models models(box.folder.path(), Dictionary(), box.liquid, box.walls);
    models.takeEffect(box.liquid, box.walls);
    models.viscosity = viscosity(box.liquid);
    const auto points = latticeBlock(period, 4, 4, 1, {-0.5f * (period - 1), 0, 0});
    std::vector<Vec3> velocities;
    for (std::size_t i = 0; i < points.size(); ++i) velocities.push_back({0, 0.01f * scalar(i % 7), 0.02f * scalar(i % 5)});
    box.place(points, velocities);
    if (poison) box.liquid.ghosts().poisonUndeclared();
    SubStep step(box.liquid, box.near, box.walls, models);
    step(0.01f);
    return box.inOrder(box.liquid.velocity);
}

std::vector<Vec3> smoothed(const Declares::Reads& reads, bool poison)
{
    return velocitiesAfter([&](Liquid& liquid) { return std::make_unique<Declares>(liquid, reads); }, poison);
}

std::vector<Vec3> addedTwice(AddsTwice::Reads reads, bool poison = true)
{
    return velocitiesAfter([&](Liquid& liquid) { return std::make_unique<AddsTwice>(liquid, reads); }, poison);
}

Columns both(Liquid& liquid) { return {valuesOf(liquid.position), valuesOf(liquid.velocity)}; }

// Particles that have other velocities than these, or none.
int differing(const std::vector<Vec3>& some, const std::vector<Vec3>& right)
{
    int count = 0;
    for (std::size_t i = 0; i < right.size(); ++i) count += !(norm(some[i] - right[i]) == 0);
    return count;
}

}

TEST(DeclaredReads, AreThere)
{
    const std::vector<Vec3> right = smoothed(both, false);
    EXPECT_EQ(differing(smoothed(both, true), right), 0);
    for (const Vec3& u : right) ASSERT_TRUE(std::isfinite(norm(u)));
}

// The support is two spacings, and at that distance neighbours count for nothing: of the planes of 16 particles one at each side has neighbours across it.
constexpr int atSides = 32;

TEST(DeclaredReads, ThatAreMissingShow)
{
    const std::vector<Vec3> right = smoothed(both, false);
    const auto withoutVelocities = smoothed([](Liquid& liquid) { return Columns{valuesOf(liquid.position)}; }, true);
    EXPECT_EQ(differing(withoutVelocities, right), atSides);
    int withoutNumber = 0;
    for (const Vec3& u : withoutVelocities) withoutNumber += std::isnan(u.y);
    EXPECT_EQ(withoutNumber, atSides);
    EXPECT_EQ(differing(smoothed([](Liquid& liquid) { return Columns{valuesOf(liquid.velocity)}; }, true), right), atSides);
    EXPECT_EQ(differing(smoothed([](Liquid&) { return Columns{}; }, true), right), atSides);
}

// The second loop finds positions that the loop between did not name: they were hidden from that one alone.
TEST(DeclaredReads, OfAnInnerLoopAreThere)
{
    const std::vector<Vec3> right = addedTwice({true, true}, false);
    for (const Vec3& u : right) ASSERT_TRUE(std::isfinite(norm(u)));
    EXPECT_EQ(differing(addedTwice({true, true}), right), 0);
}

TEST(DeclaredReads, ThatAnInnerLoopMissesShow)
{
    const std::vector<Vec3> right = addedTwice({true, true}, false);
    EXPECT_EQ(differing(addedTwice({false, true}), right), atSides);            // ghosts are not given the sums
    EXPECT_EQ(differing(addedTwice({true, false}), right), atSides);            // they have positions, which are hidden
    EXPECT_EQ(differing(addedTwice({true, false}, false), right), 0);           // as none is without the poison
}
