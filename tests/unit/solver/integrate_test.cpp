// SPDX-License-Identifier: MIT
#include "solver/integrate.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>

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
