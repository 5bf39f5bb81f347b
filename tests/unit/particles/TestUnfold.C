// SPDX-License-Identifier: GPL-3.0-or-later
#include "particles/Unfold.H"

#include <gtest/gtest.h>

#include <cmath>

using namespace shizuku;

namespace
{

// Cyclic along x from -4 to 4 and along y from -5 to 5, open along z.
Sides cyclicSides()
{
    BoxSides box;
    const double half[] = {4, 5};
    for (int k = 0; k < 2; ++k)
    {
        for (const bool upper : {false, true})
        {
            box.kind[k][upper] = BoxSides::Kind::cyclic;
            box.at[k][upper] = upper ? half[k] : -half[k];
        }
    }
    return Sides(box, 1);
}

// A ball of a lattice, put back between the sides.
std::vector<Position> wrappedBall(double x, double y, double radius, const Sides& sides)
{
    std::vector<Position> places;
    for (double i = -4; i <= 4; ++i) for (double j = -4; j <= 4; ++j) for (double k = -4; k <= 4; ++k)
    {
        if (i*i + j*j + k*k > radius*radius) continue;
        Place place = placeOf(positionAt(x + i, y + j, k));
        place = sides.maps().imageOf(place, AtSides());
        for (int axis = 0; axis < 2; ++axis)
        {
            const std::int64_t at = axis == 0 ? place.x : place.y;
            AtSides across;
            if (at >= sides.maps().at[axis][1]) across.set(axis, AtSides::upper);
            if (at < sides.maps().at[axis][0]) across.set(axis, AtSides::lower);
            place = sides.maps().imageOf(place, across);
        }
        places.push_back(positionAt(place));
    }
    return places;
}

double extentOfPlaces(const std::vector<Position>& places, int axis)
{
    double low = 1e9, high = -1e9;
    for (const Position& each : places)
    {
        const Place x = placeOf(each);
        const double at = quanta::lengthOf(axis == 0 ? x.x : axis == 1 ? x.y : x.z);
        low = std::fmin(low, at);
        high = std::fmax(high, at);
    }
    return high - low;
}

constexpr double joinReach = 1.5;

TEST(JoinedAcross, ABallAcrossASideIsABallAgain)
{
    const Sides sides = cyclicSides();
    for (const auto& [x, y] : {std::pair(3.25, 0.), std::pair(-3.75, 0.), std::pair(0., 4.5), std::pair(3.25, 4.5)})
    {
        const auto apart = wrappedBall(x, y, 2.5, sides), joined = joinedAcross(apart, sides, joinReach);
        ASSERT_EQ(joined.size(), apart.size());
        EXPECT_TRUE(extentOfPlaces(apart, 0) > 5 || extentOfPlaces(apart, 1) > 5);
        for (int axis = 0; axis < 3; ++axis) EXPECT_DOUBLE_EQ(extentOfPlaces(joined, axis), 4) << x << ' ' << y << ", axis " << axis;
    }
}

// Whole quanta: a period away, to the bit.
TEST(JoinedAcross, PlacesMoveByWholePeriods)
{
    const Sides sides = cyclicSides();
    const auto apart = wrappedBall(3.1, 0.3, 2.5, sides), joined = joinedAcross(apart, sides, joinReach);
    const std::int64_t period = sides.maps().at[0][1] - sides.maps().at[0][0];
    int moved = 0;
    for (std::size_t i = 0; i < apart.size(); ++i)
    {
        const std::int64_t by = placeOf(joined[i]).x - placeOf(apart[i]).x;
        EXPECT_EQ(by % period, 0);
        EXPECT_EQ(placeOf(joined[i]).y, placeOf(apart[i]).y);
        moved += by != 0;
    }
    EXPECT_GT(moved, 0);
    EXPECT_LT(moved, int(apart.size())/2 + 1);      // the smaller piece goes to the larger one
}

TEST(JoinedAcross, AFilmThatGoesRoundStays)
{
    const Sides sides = cyclicSides();
    std::vector<Position> film;
    for (int i = 0; i < 8; ++i) for (int k = 0; k < 3; ++k) film.push_back(positionAt(-3.5 + i, 0, k));
    const auto joined = joinedAcross(film, sides, joinReach);
    for (std::size_t i = 0; i < film.size(); ++i) EXPECT_EQ(placeOf(joined[i]).x, placeOf(film[i]).x);
}

TEST(JoinedAcross, BodiesThatTouchNoSideStay)
{
    const Sides sides = cyclicSides();
    const auto ball = wrappedBall(0, 0, 2, sides), joined = joinedAcross(ball, sides, joinReach);
    for (std::size_t i = 0; i < ball.size(); ++i) EXPECT_EQ(placeOf(joined[i]).x, placeOf(ball[i]).x);
}

}
