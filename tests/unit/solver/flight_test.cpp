// SPDX-License-Identifier: MIT
// When two bodies on their ways meet: against the closed forms of a fall and of a pass.
#include "solver/flight.hpp"

#include <support/traces.hpp>

#include <gtest/gtest.h>

namespace tamias2d::test {
namespace {

constexpr real kHeight = real(0.02);   // to fall, down to the rest gap   [m]
constexpr real kRestGap = real(0.001);
constexpr real kTick = real(0.1);      // [s]

// A disc of radius 1/2 at `place` above a point-like disc that does not move, and their contact.
struct Meeting {
    Motion a, b;
    Flight flightA, flightB;
    Contact contact;
    StepContext context;

    Meeting(Vec2 place, Vec2 velocity, Vec2 acceleration, real restitution)
    {
        b.invMass = {1, 1};
        b.invInertia = 8;
        b.center = {static_cast<double>(place.x), static_cast<double>(place.y)};
        b.velocity = velocity;
        b.acceleration = acceleration;
        contact.count = 1;
        contact.normal = (1 / length(place)) * place;
        contact.radiusB = real(0.5);
        contact.restGap = kRestGap;
        contact.restitution = restitution;
        contact.points[0].anchor.roundOnRound = true;
        context.h = kTick;
        context.invH = 1 / kTick;
        context.tuning.impactThreshold = real(0.1);
        prepareContact(contact, a, b);
        flightA = flightOf(a, context.invH);
        flightB = flightOf(b, context.invH);
    }
    FlyingPair pair() const { return {a, b, flightA, flightB}; }
    Impact next() const
    {
        const ImpactPoint points[2] = {impactPoint(contact, 0, pair()), {}};
        return nextImpact(contact, points, pair(), context);
    }
};

TEST(Flight, AFallEndsAfterTheRootOfTwiceTheHeightOverGravity)
{
    TRACES("R8", "T1", "ADR7");
    const Meeting fall({0, real(0.5) + kRestGap + kHeight}, {0, 0}, {0, -10}, 1);
    EXPECT_NEAR(double(fall.next().time), std::sqrt(2 * double(kHeight) / 10), 1e-6);
}

TEST(Flight, AMeetingBeyondTheTickIsNone)
{
    TRACES("ADR7");
    const Meeting slow({0, real(0.5) + kRestGap + kHeight}, {0, real(-0.19)}, {0, 0}, 1);
    EXPECT_EQ(slow.next().time, kNever);
    const Meeting fast({0, real(0.5) + kRestGap + kHeight}, {0, real(-0.21)}, {0, 0}, 1);
    EXPECT_NEAR(double(fast.next().time), 0.02 / 0.21, 1e-6);
}

TEST(Flight, AnObliqueMeetingOfRoundsIsWhereTheirDistanceSaysAndAlongTheirCenters)
{
    TRACES("DD8", "ADR7");
    // Along y = 0.3 the distance is r = 0.501 at x = -0.4012...
    const real y = real(0.3), speed = 4;
    const double r = 0.5 + double(kRestGap), x = std::sqrt(r * r - double(y) * double(y));
    const Meeting pass({-real(x) - real(0.3), y}, {speed, 0}, {0, 0}, 1);
    const Impact impact = pass.next();
    ASSERT_LT(impact.time, kTick);
    EXPECT_NEAR(double(impact.time), 0.3 / 4, 1e-6);
    const Moment moment = momentAt(pass.contact, pass.contact.points[0].anchor, pass.pair(), impact.time);
    EXPECT_NEAR(double(moment.normal.x), -x / r, 1e-5);
    EXPECT_NEAR(double(moment.normal.y), double(y) / r, 1e-5);
}

TEST(Flight, APassBesideIsNoMeeting)
{
    TRACES("R7", "ADR7");
    const Meeting pass({real(-0.2), real(0.5) + 2 * kRestGap}, {4, 0}, {0, 0}, 1);
    EXPECT_EQ(pass.next().time, kNever);
}

TEST(Flight, WhatSteadyForcesCloseInATickIsNoImpact)
{
    TRACES("ADR7");
    const Meeting rest({0, real(0.5) + kRestGap}, {0, real(-0.05)}, {0, -10}, 1);
    EXPECT_EQ(rest.next().time, kNever);  // threshold 0.1 x 10 x 0.1 m/s
}

}  // namespace
}  // namespace tamias2d::test
