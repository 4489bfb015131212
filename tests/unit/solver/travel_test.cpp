// SPDX-License-Identifier: MIT
// The bounds by which pairs are left unlooked at: nothing may ever go further than they say.
#include "solver/flight.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tamias2d {
namespace {

struct Sample {
    Motion motion;
    Flight flight;
};

Sample randomSample(std::mt19937& random)
{
    std::uniform_real_distribution<real> any(-5, 5), size(0, 2);
    Sample s;
    s.motion.extent = size(random);
    s.flight.velocity = {any(random), any(random)};
    s.flight.acceleration = {100 * any(random), 100 * any(random)};
    s.flight.spin = 10 * any(random);
    s.flight.spinRate = 1000 * any(random);
    return s;
}

// Where a point of the body at `angle` on its rim is at `t`.
Vec2 rimAt(const Sample& s, real angle, real t)
{
    const Rot turned = Rot::ofAngle(static_cast<double>(angle + s.flight.turnAt(t)));
    return s.flight.shiftAt(t) + rotate(turned, Vec2{s.motion.extent, 0});
}

TEST(Travel, NoTwoPointsGoFurtherAgainstEachOtherThanTheBound)
{
    TRACES("ADR7", "R8");
    std::mt19937 random(5);
    std::uniform_real_distribution<real> angle(0, 6), part(0, 1);
    constexpr real kH = real(1) / 480;
    for (int i = 0; i < 2000; ++i) {
        const Sample a = randomSample(random), b = randomSample(random);
        const real bound = travelWithin(a.flight, a.motion, b.flight, b.motion, kH);
        const real t = kH * part(random), onA = angle(random), onB = angle(random);
        const Vec2 before = rimAt(b, onB, 0) - rimAt(a, onA, 0), after = rimAt(b, onB, t) - rimAt(a, onA, t);
        EXPECT_LE(length(after - before), bound * real(1.001)) << "sample " << i;
    }
}

TEST(Travel, NoPointIsFasterThanTheBound)
{
    TRACES("ADR21", "R8");
    std::mt19937 random(6);
    std::uniform_real_distribution<real> angle(0, 6), part(0, 1);
    constexpr real kH = real(1) / 480;
    for (int i = 0; i < 2000; ++i) {
        const Sample s = randomSample(random);
        const real t = kH * part(random);
        const Vec2 arm = rotate(Rot::ofAngle(static_cast<double>(angle(random))), Vec2{s.motion.extent, 0});
        const Vec2 velocity =
            s.flight.velocity + t * s.flight.acceleration + cross(s.flight.spin + t * s.flight.spinRate, arm);
        EXPECT_LE(length(velocity), fastestPoint(s.flight.velocity, s.flight.spin, s.flight.acceleration,
                                                 s.flight.spinRate, s.motion.extent, kH))
            << "sample " << i;
    }
}

}  // namespace
}  // namespace tamias2d
