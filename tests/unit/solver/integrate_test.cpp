// SPDX-License-Identifier: MIT
#include "solver/integrate.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tamias2d {
namespace {

constexpr double kTolerance = std::is_same_v<real, double> ? 1e-13 : 1e-5;

// v' = a - c v from v0, exactly.
struct Damped {
    double c, a, v0;
    double grown(double t) const { return -std::expm1(-c * t) / c; }
    double velocity(double t) const { return v0 * std::exp(-c * t) + a * grown(t); }
    double position(double t) const { return v0 * grown(t) + a * (t - grown(t)) / c; }
};

TEST(Integration, OfExponentialDampingWithAConstantForceIsExact)
{
    TRACES("LC2", "IM1", "IM2");
    for (const double c : {1e-3, 0.1, 2.0, 24.0, 300.0}) {
        const double h = 1.0 / 240;
        Motion m;
        m.velocity = {3, 0};
        m.spin = 3;
        m.acceleration = {5, 0};
        m.spinRate = 5;
        m.invMass = {1, 1};
        m.invInertia = 1;
        m.damping = m.spinDamping = makeDamping(real(c), real(h));
        double turned = 0, before = m.angle;
        for (int i = 0; i < 240; ++i) {
            kickFirst(m, {});
            drift(m, {}, real(h));
            kickSecond(m, {});
            turned += m.angle - before + (m.angle < before ? kTwoPi : 0.0);
            before = m.angle;
        }
        const Damped exact{c, 5, 3};
        EXPECT_NEAR(m.velocity.x / exact.velocity(1), 1, 100 * kTolerance) << "c = " << c;
        EXPECT_NEAR(m.center.x / exact.position(1), 1, 100 * kTolerance) << "c = " << c;
        EXPECT_NEAR(m.spin / exact.velocity(1), 1, 100 * kTolerance) << "c = " << c;
        EXPECT_NEAR(turned / exact.position(1), 1, 100 * kTolerance) << "c = " << c;
    }
}

// Of all strengths: as from v0 = 0 a body falls all the way, it must never climb.
TEST(Integration, OfATickIsExactForEveryStrengthOfDamping)
{
    TRACES("LC2", "IM1", "IM2");
    const double h = 1.0 / 512, exact = std::is_same_v<real, double> ? 1e-13 : 3e-7;
    for (const double v0 : {0.0, 3.0}) {
        for (double ch = 1e-9; ch < 2e6; ch *= 1.7) {
            const double c = static_cast<double>(real(ch / h)), a = -10;
            Motion m;
            m.velocity = {real(v0), 0};
            m.spin = real(v0);
            m.acceleration = {real(a), 0};
            m.spinRate = real(a);
            m.invMass = {1, 1};
            m.invInertia = 1;
            m.damping = m.spinDamping = makeDamping(real(c), real(h));
            kickFirst(m, {});
            drift(m, {}, real(h));
            kickSecond(m, {});

            // The two parts of the truth, as their sum may cancel.
            const Damped start{c, 0, v0}, force{c, a, 0};
            double series = 1;
            for (const int n : {8, 7, 6, 5, 4, 3}) series = 1 - c * h / n * series;
            const double fall = c * h > 0.02 ? force.position(h) : a * h * h / 2 * series;
            const double speed = std::abs(start.velocity(h)) + std::abs(force.velocity(h));
            const double way = start.position(h) + std::abs(fall);
            EXPECT_NEAR(m.velocity.x, start.velocity(h) + force.velocity(h), exact * speed) << "c h = " << ch;
            EXPECT_NEAR(m.center.x, start.position(h) + fall, exact * way) << "c h = " << ch;
            EXPECT_EQ(m.spin, m.velocity.x);
            EXPECT_EQ(m.angle, wrapAngle(m.center.x));
        }
    }
}

// A kick too small to show is not lost; one that the velocity does not stem from is forgotten.
TEST(Integration, SmallKicksAddUpUntilTheVelocityIsSet)
{
    TRACES("IM1", "IM2");
    const real half = std::numeric_limits<real>::epsilon() / 4;  // a quarter of the last digit of 1
    Motion m;
    m.invMass = {1, 1};
    m.invInertia = 1;
    m.damping = m.spinDamping = makeDamping(0, 1);
    m.velocity = {1, 1};
    m.spin = 1;
    m.acceleration = {2 * half, 0};
    m.spinRate = 2 * half;
    for (int i = 0; i < 8; ++i) {
        kickFirst(m, {});
        kickSecond(m, {});
    }
    const real grown = std::is_same_v<real, double> ? real(1) : 1 + 16 * half;
    EXPECT_EQ(m.velocity.x, grown);
    EXPECT_EQ(m.velocity.y, 1);
    EXPECT_EQ(m.spin, grown);

    m.velocity.x = 2;
    m.acceleration = {};
    kickFirst(m, {});
    EXPECT_EQ(m.velocity.x, 2);
}

TEST(Integration, ClampsSpeedAtTheBoundAndSaysSo)
{
    TRACES("DC-v", "DC-omega");
    Motion m;
    m.velocity = {real(3e6), real(4e6)};
    EXPECT_TRUE(clampSpeed(m, 1));
    EXPECT_NEAR(length(m.velocity) / real(1e6), 1, 1e-6);
    EXPECT_FALSE(clampSpeed(m, 2));
}

}  // namespace
}  // namespace tamias2d
