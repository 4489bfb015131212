// SPDX-License-Identifier: MIT
#include "math/angle.hpp"
#include "support/traces.hpp"

#include <tamias2d/math/scalar.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tamias2d::test {
namespace {

TEST(AngleBetween, AgreesWithTheArcTangent)
{
    TRACES("ADR6");
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> part(-1, 1);
    for (int i = 0; i < 20000; ++i) {
        const DVec2 a = {part(random), part(random)}, b = {part(random) * 1e3, part(random) * 1e3};
        const double expected = std::atan2(cross(a, b), dot(a, b));
        const double given = angleBetween(a, b);
        // Compared around the circle: 0 and 2 pi are neighbours.
        ASSERT_NEAR(std::remainder(given - expected, kTwoPi), 0, 2e-15)
            << a.x << ' ' << a.y << ' ' << b.x << ' ' << b.y;
        ASSERT_GE(given, 0);
        ASSERT_LT(given, kTwoPi);
    }
}

TEST(AngleBetween, KnowsTheQuarterTurns)
{
    TRACES("ADR6");
    EXPECT_DOUBLE_EQ(angleBetween({2, 0}, {5, 0}), 0);
    EXPECT_DOUBLE_EQ(angleBetween({2, 0}, {0, 3}), kPi / 2);
    EXPECT_DOUBLE_EQ(angleBetween({2, 0}, {-1, 0}), kPi);
    EXPECT_DOUBLE_EQ(angleBetween({2, 0}, {0, -1}), 3 * kPi / 2);
}

}  // namespace
}  // namespace tamias2d::test
