// SPDX-License-Identifier: MIT
#include "contacts/mixing.hpp"
#include "contacts/rows.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tamias2d {
namespace {

TEST(ContactBlock, SolvesTheComplementarityProblemOfTwoPoints)
{
    TRACES("IM3", "ADR7");
    std::mt19937 random(1);
    std::uniform_real_distribution<double> stiffness(0.5, 2), residual(-3, 3), coupling(-0.9, 0.9);
    for (int trial = 0; trial < 10000; ++trial) {
        const double k1 = stiffness(random), k2 = stiffness(random),
                     k12 = coupling(random) * std::sqrt(k1 * k2);
        const double r1 = residual(random), r2 = residual(random);
        real x1 = -1, x2 = -1;
        ASSERT_TRUE(solveBlock(real(k1), real(k2), real(k12), real(r1), real(r2), x1, x2));
        const double w1 = r1 + k1 * double(x1) + k12 * double(x2),
                     w2 = r2 + k12 * double(x1) + k2 * double(x2);
        const double tolerance = std::is_same_v<real, double> ? 1e-11 : 1e-4;
        EXPECT_GE(x1, 0);
        EXPECT_GE(x2, 0);
        EXPECT_GE(w1, -tolerance) << "trial " << trial;
        EXPECT_GE(w2, -tolerance) << "trial " << trial;
        EXPECT_NEAR(double(x1) * w1, 0, 10 * tolerance) << "trial " << trial;
        EXPECT_NEAR(double(x2) * w2, 0, 10 * tolerance) << "trial " << trial;
    }
}

TEST(ContactBlock, RefusesTwoPointsThatAreOne)
{
    TRACES("IM3");
    real x1, x2;
    EXPECT_FALSE(solveBlock(real(1), real(1), real(1), real(-1), real(-1), x1, x2));
    // Within rounding of the border of two cases; in float none of the four holds.
    const real r1 = real(-0.29342593), r2 = real(-0.19688597);
    const bool solved = solveBlock(real(1.15146565), real(1.34133530), real(0.77262241), r1, r2, x1, x2);
    EXPECT_TRUE(!solved || x1 > 0 || x2 > 0) << x1 << ", " << x2;
}

TEST(ContactPoint, BothArmsLeadToOnePlace)
{
    TRACES("GD1", "DD13");
    std::mt19937 random(2);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int trial = 0; trial < 1000; ++trial) {
        const auto vec = [&] { return Vec2{real(any(random)), real(any(random))}; };
        Contact c;
        const real angle = real(any(random) * 3);
        c.normal = rotate(Rot::ofAngle(double(angle)), {1, 0});
        c.radiusA = real(0.1);
        c.radiusB = real(0.3);
        ManifoldPoint anchor{vec(), vec(), trial % 2 == 0, 0};
        const Vec2 d = 3 * vec();
        const PlacedPoint p =
            placePoint(c, c.normal, anchor, Rot::ofAngle(any(random)), Rot::ofAngle(any(random)), d);
        EXPECT_NEAR(length(p.armA - (p.armB + d)), 0, 1e-5) << "trial " << trial;
    }
}

TEST(ContactPoint, AnImpulseThereKeepsLinearAndAngularMomentum)
{
    TRACES("GD1", "T2", "DD10");
    Motion a, b;
    a.center = {1, 2};
    b.center = {1.5, 3.2};
    a.invMass = {real(0.5), real(0.5)};
    b.invMass = {real(0.25), real(0.25)};
    a.invInertia = 2;
    b.invInertia = 1;
    a.velocity = {1, 2};
    b.velocity = {-3, 1};
    const Position point{1.2, 2.7};
    const auto angular = [](const Motion& m) {
        const DVec2 p{m.center.x, m.center.y};
        return cross(p, (1 / double(m.invMass.x)) * toDVec2(m.velocity)) +
               double(m.spin) / double(m.invInertia);
    };
    const double before = angular(a) + angular(b);
    applyImpulse(a, b, toVec2(point - a.center), toVec2(point - b.center), {real(0.7), real(-1.3)});
    EXPECT_NEAR(angular(a) + angular(b), before, 1e-5);
    EXPECT_NEAR(a.velocity.x / real(0.5) + b.velocity.x / real(0.25), 1 / 0.5 - 3 / 0.25, 1e-5);
}

TEST(Mixing, FollowsEachRuleAndTheStrongerOfTwo)
{
    TRACES("R3", "DC-C_R");
    using enum MixingRule;
    const real a = real(0.25), b = 1;
    EXPECT_FLOAT_EQ(float(mixed(a, b, World, World, GeometricMean)), 0.5f);
    EXPECT_FLOAT_EQ(float(mixed(a, b, Average, World, GeometricMean)), 0.625f);
    EXPECT_FLOAT_EQ(float(mixed(a, b, World, Minimum, GeometricMean)), 0.25f);
    EXPECT_FLOAT_EQ(float(mixed(a, b, Minimum, Multiply, GeometricMean)), 0.25f);
    EXPECT_FLOAT_EQ(float(mixed(a, b, Average, Maximum, GeometricMean)), 1.0f);
}

}  // namespace
}  // namespace tamias2d
