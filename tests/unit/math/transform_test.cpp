// SPDX-License-Identifier: MIT
#include "support/traces.hpp"

#include <tamias2d/math/transform.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace tamias2d::test {
namespace {

constexpr double kFewRoundings = 8 * static_cast<double>(std::numeric_limits<real>::epsilon());

TEST(Vectors, ThePerpendicularIsAQuarterTurnCounterClockwise)
{
    TRACES("A4", "DD9");
    EXPECT_EQ(perpendicular(Vec2{2, 1}), (Vec2{-1, 2}));
    EXPECT_GT(cross(Vec2{1, 0}, Vec2{0, 1}), 0);
    // A point to the right of the axis of a counter-clockwise turn moves up.
    EXPECT_EQ(cross(real(3), Vec2{2, 0}), (Vec2{0, 6}));
}

TEST(Transforms, GoingToTheWorldAndBackChangesNothing)
{
    TRACES("A3");
    for (double angle = -10; angle < 10; angle += 0.37) {
        const Transform t = Transform::at({3, -7}, angle);
        const Vec2 local = {real(1.5), real(-0.25)};
        const Vec2 back = toLocal(t, toWorld(t, local));
        EXPECT_NEAR(double(back.x), double(local.x), kFewRoundings) << angle;
        EXPECT_NEAR(double(back.y), double(local.y), kFewRoundings) << angle;
    }
}

TEST(Transforms, TurnCounterClockwise)
{
    TRACES("A4");
    const Position p = toWorld(Transform::at({10, 20}, kPi / 2), {1, 0});
    EXPECT_NEAR(p.x, 10, kFewRoundings);
    EXPECT_NEAR(p.y, 21, kFewRoundings);
}

TEST(Transforms, KeepTheirAngleInOneTurn)
{
    TRACES("R4");
    EXPECT_NEAR(Transform::at({}, -kPi / 2).angle, 3 * kPi / 2, 1e-15);
    EXPECT_NEAR(Transform::at({}, 5 * kPi).angle, kPi, 1e-14);
}

// What Position is for: a micrometre still counts a thousand kilometres from the origin.
TEST(Transforms, ResolveAMicrometreFarFromTheOrigin)
{
    TRACES("ADR3");
    const Position far = {1e6, -1e6};
    const DVec2 difference = (far + DVec2{1e-6, 2e-6}) - far;
    EXPECT_NEAR(difference.x, 1e-6, 2e-10);
    EXPECT_NEAR(difference.y, 2e-6, 2e-10);
}

}  // namespace
}  // namespace tamias2d::test
