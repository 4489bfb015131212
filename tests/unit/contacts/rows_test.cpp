// SPDX-License-Identifier: MIT
#include "contacts/mixing.hpp"
#include "contacts/rows.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tamias2d {
namespace {

// The impulses that solveNormalPair makes of x1 and x2, whose residuals are then r1 and r2.
struct Pair {
    double k1, k2, k12;
    real x1 = 0, x2 = 0;

    void solve(double r1, double r2)
    {
        const double determinant = k1 * k2 - k12 * k12;
        const double inverse = determinant > 1e-4 * k1 * k2 ? 1 / determinant : 0;
        solveNormalPair(real(k1), real(k2), real(k12), real(1 / k1), real(1 / k2), real(inverse), real(r1),
                        real(r2), x1, x2);
    }
};

TEST(ContactBlock, SolvesTheComplementarityProblemOfTwoPoints)
{
    TRACES("IM3", "ADR7");
    std::mt19937 random(1);
    std::uniform_real_distribution<double> stiffness(0.5, 2), residual(-3, 3), coupling(-0.9, 0.9),
        carried(0, 2);
    for (int trial = 0; trial < 10000; ++trial) {
        Pair p{stiffness(random), stiffness(random), 0};
        p.k12 = coupling(random) * std::sqrt(p.k1 * p.k2);
        // From impulses at hand, of which some are none; the answer is the same as from none.
        const double x1 = trial % 3 == 0 ? 0 : double(real(carried(random)));
        const double x2 = trial % 2 == 0 ? 0 : double(real(carried(random)));
        p.x1 = real(x1);
        p.x2 = real(x2);
        const double r1 = residual(random), r2 = residual(random);
        p.solve(r1, r2);
        const double w1 = r1 + p.k1 * (double(p.x1) - x1) + p.k12 * (double(p.x2) - x2),
                     w2 = r2 + p.k12 * (double(p.x1) - x1) + p.k2 * (double(p.x2) - x2);
        const double tolerance = std::is_same_v<real, double> ? 1e-11 : 1e-4;
        EXPECT_GE(p.x1, 0);
        EXPECT_GE(p.x2, 0);
        EXPECT_GE(w1, -tolerance) << "trial " << trial;
        EXPECT_GE(w2, -tolerance) << "trial " << trial;
        EXPECT_NEAR(double(p.x1) * w1, 0, 10 * tolerance) << "trial " << trial;
        EXPECT_NEAR(double(p.x2) * w2, 0, 10 * tolerance) << "trial " << trial;
    }
}

TEST(ContactBlock, LeavesImpulsesAtRestAsTheyAre)
{
    TRACES("R8", "ADR7");
    Pair p{1.3, 0.7, 0.2, real(0.123456789), real(0.987654321)};
    const real x1 = p.x1, x2 = p.x2;
    p.solve(0, 0);
    EXPECT_EQ(p.x1, x1);
    EXPECT_EQ(p.x2, x2);
}

TEST(ContactBlock, VisitsTwoPointsThatAreOneInTurn)
{
    TRACES("IM3");
    Pair p{1, 1, 1};
    p.solve(-1, -1);  // the first takes all, and leaves the second nothing to do
    EXPECT_EQ(p.x1, real(1));
    EXPECT_EQ(p.x2, real(0));
    // Within rounding of the border of two cases; in float none of the four holds.
    Pair q{1.15146565, 1.34133530, 0.77262241};
    q.solve(-0.29342593, -0.19688597);
    EXPECT_GE(q.x1, real(0));
    EXPECT_GE(q.x2, real(0));
    EXPECT_GT(q.x1 + q.x2, real(0));
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

TEST(ContactPoint, APassKeepsLinearAndAngularMomentum)
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
    Contact c;
    c.normal = {real(0.6), real(0.8)};
    c.friction = real(0.5);
    c.count = 2;
    c.restGap = real(0.001);
    for (const int k : {0, 1}) {
        const Position point{1.2 + 0.3 * k, 2.7 - 0.2 * k};
        c.points[k].armA = toVec2(point - a.center);
        c.points[k].armB = toVec2(point - b.center);
    }
    const auto angular = [](const Motion& m) {
        const DVec2 p{m.center.x, m.center.y};
        return cross(p, (1 / double(m.invMass.x)) * toDVec2(m.velocity)) +
               double(m.spin) / double(m.invInertia);
    };
    const double before = angular(a) + angular(b);
    EXPECT_GT(solveContact(c, a, b, makeStepContext({}, 1, 0, 1.0 / 60, 4)), real(0.1));
    EXPECT_NE(c.points[0].tangentImpulse, real(0));
    EXPECT_NEAR(angular(a) + angular(b), before, 1e-5);
    EXPECT_NEAR(a.velocity.x / real(0.5) + b.velocity.x / real(0.25), 1 / 0.5 - 3 / 0.25, 1e-5);
    EXPECT_NEAR(a.velocity.y / real(0.5) + b.velocity.y / real(0.25), 2 / 0.5 + 1 / 0.25, 1e-5);
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
