// SPDX-License-Identifier: GPL-3.0-or-later
// The curvature that a step begins with, of a ball that shrinks from step to step.

#include "models/surfaceTension/surfaceCurvature/CurvatureAtStart.H"

#include "models/surfaceTension/surfaceCurvature/RegressedCurvature.H"
#include "support/DisorderedBall.H"
#include "support/LiquidCase.H"

#include <gtest/gtest.h>

using namespace shizuku;
using namespace shizuku::test;

namespace
{

class ShrinkingBall : public LiquidCase
{
public:
    ShrinkingBall() : curvature_(Dictionary::parse("", "constant/models"), liquid, surface, 1), atStart_(liquid) {}

    // The mean over the surface, of the ball that is so large now.
    double mean(scalar size, bool brought, bool ends = true, scalar share = 1)
    {
        auto points = points_;
        for (Vec3& x : points) x = size * x;
        move(points);
        CurvatureField field = curvature_.normals(liquid, near, walls);
        curvature_.curvatures(field, liquid, near, walls);
        if (brought) atStart_.bring(field, liquid, near, surface, share);
        if (brought && ends) atStart_.commit();
        const int found = int(surface.particles().before.download().back());
        const auto kappa = download(field.curvature, found);
        const auto normal = download(field.normal, found);
        double sum = 0, shares = 0;
        for (int k = 0; k < found; ++k)
        {
            if (squared(normal[k]) == 0) continue;
            sum += normal[k].w * kappa[k];
            shares += normal[k].w;
        }
        return sum / shares;
    }

private:
    // Keeps what fields know of the particles.
    void move(const std::vector<Vec3>& points)
    {
        if (liquid.owned() == 0) return place(points);
        auto x = liquid.predicted.download();
        const auto id = liquid.id.download();
        for (std::size_t i = 0; i < id.size(); ++i)
        {
            const Vec3 at = liquid.spacing() * points[id[i]];
            x[i] = positionAt(at.x, at.y, at.z);
        }
        liquid.predicted.upload(x);
        near.update(liquid, surface.support());
        reconstruct(surface);
    }

    std::vector<Vec3> points_ = disorderedBall(7);
    RegressedCurvature curvature_;
    CurvatureAtStart atStart_;
};

}

// What is read at the positions of a step is what the next one begins with. A mean over neighbours of what changes by 3 % each time keeps a hundredth of it.
TEST(CurvatureAtStart, IsThatOfTheStepBefore)
{
    const double first = ShrinkingBall().mean(1, false), second = ShrinkingBall().mean(0.97f, false);
    EXPECT_GT(second / first, 1.015);
    ShrinkingBall ball;
    EXPECT_NEAR(ball.mean(1, true) / first, 1, 1e-6);           // no step before it
    EXPECT_NEAR(ball.mean(0.97f, true) / first, 1, 0.003);
    EXPECT_NEAR(ball.mean(0.97f, true) / second, 1, 0.003);
}

// A share of the way back.
TEST(CurvatureAtStart, IsWhatTheShareAsksFor)
{
    const double first = ShrinkingBall().mean(1, false), second = ShrinkingBall().mean(0.97f, false);
    for (const scalar share : {0.0f, 0.25f})
    {
        ShrinkingBall ball;
        ball.mean(1, true);
        EXPECT_NEAR(ball.mean(0.97f, true, true, share), second + share * (first - second), 0.003 * share * first + 1e-6 * second);
    }
}

// A step that is made again, with longer lists, begins where it began.
TEST(CurvatureAtStart, OfAStepThatIsMadeAgainIsTheSame)
{
    ShrinkingBall ball;
    ball.mean(1, true);
    const double once = ball.mean(0.97f, true, false);
    EXPECT_EQ(ball.mean(0.97f, true), once);
}
