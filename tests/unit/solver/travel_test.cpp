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
    s.motion.extent = s.flight.extent = size(random);
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

Vec2 randomAxis(std::mt19937& random)
{
    std::uniform_real_distribution<double> angle(0, 6);
    return rotate(Rot::ofAngle(angle(random)), Vec2{1, 0});
}

TEST(Travel, NoTwoPointsComeNearerAlongAnAxisThanTheBound)
{
    TRACES("ADR7", "R8");
    std::mt19937 random(5);
    std::uniform_real_distribution<real> angle(0, 6), part(0, 1);
    constexpr real kH = real(1) / 480;
    for (int i = 0; i < 5000; ++i) {
        const Sample a = randomSample(random), b = randomSample(random);
        const Vec2 axis = randomAxis(random);
        const real from = i % 2 == 0 ? real(0) : kH * part(random);
        const real bound = approachWithin(axis, a.flight, b.flight, from, kH);
        const real t = from + (kH - from) * part(random), onA = angle(random), onB = angle(random);
        const Vec2 before = rimAt(b, onB, from) - rimAt(a, onA, from);
        const Vec2 after = rimAt(b, onB, t) - rimAt(a, onA, t);
        EXPECT_GE(dot(axis, after - before), -bound - real(1e-6)) << "sample " << i;
    }
}

TEST(Travel, AStripBetweenTwoBodiesIsEmptyWhenTheyHaveGoneOn)
{
    TRACES("ADR7", "R8");
    std::mt19937 random(7);
    std::uniform_real_distribution<real> angle(0, 6), part(0, 1);
    constexpr real kH = real(1) / 480;
    for (int i = 0; i < 5000; ++i) {
        const Sample a = randomSample(random), b = randomSample(random);
        const Vec2 axis = randomAxis(random);
        const real t = kH * part(random), onA = angle(random), onB = angle(random);
        const real first = dot(axis, rimAt(b, onB, 0) - rimAt(a, onA, 0));
        const real last = dot(axis, rimAt(b, onB, t) - rimAt(a, onA, t));
        EXPECT_LE(apartAt(t, {axis, first}, a.flight, b.flight).gap, last + real(2e-6)) << "sample " << i;
        EXPECT_LE(apartBefore(t, {axis, last}, a.flight, b.flight).gap, first + real(2e-6)) << "sample " << i;
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
