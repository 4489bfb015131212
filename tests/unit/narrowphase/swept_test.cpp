// SPDX-License-Identifier: MIT
#include "narrowphase/swept.hpp"
#include "support/convex.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tamias2d {
namespace {

using test::convexOf;

Trajectory path(double x, double y, double angle, double vx, double vy, double spin)
{
    Trajectory p;
    p.position = {static_cast<real>(x), static_cast<real>(y)};
    p.angle = angle;
    p.rotation = Rot::ofAngle(angle);
    p.velocity = {static_cast<real>(vx), static_cast<real>(vy)};
    p.spin = static_cast<real>(spin);
    return p;
}

const Geometry kMovers[] = {Circle{{}, real(0.3)}, Capsule{{real(-0.4), 0}, {real(0.4), 0}, real(0.1)},
                            makeBox(1, real(0.05)), makeBox(real(0.6), real(0.6), real(0.1)),
                            makeRegularPolygon(5, real(0.5))};

TEST(Swept, LookingAheadChangesNoBit)
{
    TRACES("ADR6");
    std::mt19937 random(12);
    std::uniform_real_distribution<double> any(-3, 3);
    for (int trial = 0; trial < 1000; ++trial) {
        Trajectory way = path(any(random), any(random), any(random), any(random), any(random),
                              trial % 3 == 0 ? 0.0 : any(random));
        way.spinRate = static_cast<real>(any(random));
        const real times[] = {0, real(0.01), real(0.5), -1};
        Pose before[4];
        for (int i = 0; i < 4; ++i) before[i] = way.at(times[i]);
        way.lookAhead(real(0.5));
        for (int i = 0; i < 4; ++i) {
            const Pose after = way.at(times[i]);
            EXPECT_EQ(after.p, before[i].p);
            EXPECT_EQ(after.q.c, before[i].q.c);
            EXPECT_EQ(after.q.s, before[i].q.s);
        }
    }
}

// A box that lies 7 mm in a wall of half a meter and is about to be pulled right through it: the wall pushes
// it back, and not on to the far side, as fast and as far as the pull may be.
TEST(Swept, WhatLiesInAWallIsPartedOnTheSideItCameInBy)
{
    TRACES("T5", "R7");
    const Convex wall = convexOf(makeBox(40, real(0.5))), box = convexOf(makeBox(real(0.5), real(0.2)));
    for (const double height : {0.349, 0.343, 0.32})  // of the center; 0.35 where they touch
        for (const double speed : {-1.0, -10.0, -100.0, -1000.0, -5000.0})
            for (const double aside : {0.0, 3.0, -40.0})
                for (const double spin : {0.0, 0.5, 30.0}) {
                    const SweptPair pair{wall, box, path(0, 0, 0, 0, 0, 0),
                                         path(0.1, height, 0, aside, speed, spin), real(2e-4)};
                    const SweptResult result = collideSwept(pair, 0, real(1.0 / 60));
                    ASSERT_TRUE(result.near && result.manifold.count > 0)
                        << "height " << height << ", speed " << speed << ", spin " << spin;
                    EXPECT_GT(result.manifold.normal.y, 0.9)
                        << "height " << height << ", speed " << speed << ", spin " << spin;
                }
}

// Whatever two shapes do in a step: if they overlap at any time of it, there is a manifold.
TEST(Swept, NoPairThatMeetsIsMissed)
{
    TRACES("T5", "R7");
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-1.5, 1.5), speed(-400, 400), spin(-200, 200),
        turn(0, kTwoPi);
    const double dt = 1.0 / 240;
    int met = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Convex a = convexOf(kMovers[random() % 5]), b = convexOf(kMovers[random() % 5]);
        const double w = trial % 2 == 0 ? 0.0 : 1.0;
        const SweptPair pair{
            a, b,
            path(place(random), place(random), turn(random), speed(random), speed(random), w * spin(random)),
            path(place(random), place(random), turn(random), speed(random), speed(random), w * spin(random)),
            real(1e-4)};
        if (gapAt(pair, 0) < real(1e-3)) continue;  // start apart
        bool meets = false;
        for (int i = 0; i <= 400 && !meets; ++i)
            meets = gapAt(pair, static_cast<real>(dt * i / 400)) < real(-1e-3);
        if (!meets) continue;
        ++met;
        const SweptResult result = collideSwept(pair, 0, static_cast<real>(dt));
        EXPECT_TRUE(result.near && result.manifold.count > 0) << "trial " << trial << " was missed";
        if (!result.manifold.atImpact) continue;
        const real gap = gapAt(pair, result.manifold.time);
        EXPECT_GT(gap, real(-2e-3)) << "trial " << trial << ": taken too late, at a gap of " << gap << " m";
    }
    EXPECT_GT(met, 300);
}

// Against projections of all corners on the axis.
TEST(Swept, TheStripBetweenTwoShapesIsEmpty)
{
    TRACES("T5", "R7");
    std::mt19937 random(13);
    std::uniform_real_distribution<double> place(-1, 1), turn(0, kTwoPi), speed(-100, 100), spin(-50, 50);
    const double tolerance = std::is_same_v<real, double> ? 1e-12 : 2e-6;
    int known = 0, apart = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Convex a = convexOf(kMovers[random() % 5]), b = convexOf(kMovers[random() % 5]);
        const SweptPair pair{
            a, b,
            path(place(random), place(random), turn(random), speed(random), speed(random), spin(random)),
            path(place(random), place(random), turn(random), speed(random), speed(random), spin(random)),
            real(1e-3)};
        const Apart strip = collideSwept(pair, 0, real(1) / 240).apart;
        if (strip.gap < -100) continue;
        ++known;
        apart += strip.gap > 0 ? 1 : 0;
        const auto along = [&strip](const Trajectory& way, Vec2 corner) {
            return static_cast<double>(dot(strip.axis, way.position + rotate(way.rotation, corner)));
        };
        double ofA = -1e9, ofB = 1e9;
        for (int i = 0; i < a.count; ++i) ofA = std::max(ofA, along(pair.pathA, a.vertices[i]));
        for (int i = 0; i < b.count; ++i) ofB = std::min(ofB, along(pair.pathB, b.vertices[i]));
        const double gap = ofB - ofA - static_cast<double>(a.radius + b.radius);
        EXPECT_NEAR(length(strip.axis), 1, tolerance);
        EXPECT_GE(gap, static_cast<double>(strip.gap) - tolerance) << "trial " << trial;
    }
    EXPECT_GT(known, 15000);
    EXPECT_GT(apart, 5000);
}

TEST(Swept, ABoxGlidingOverASeamNeverSeesTheSideOfTheNextTile)
{
    TRACES("LC1");
    const Convex tile = convexOf(makeBox(1, 1)), box = convexOf(makeBox(1, 1));
    for (double x = -1.2; x < 0; x += 0.01) {
        for (const double v : {1.0, 5.0, 20.0, 200.0}) {
            const SweptPair pair{tile, box, path(0, 0, 0, 0, 0, 0), path(x, 1.001, 0, v, 0, 0), real(1e-3)};
            const SweptResult result = collideSwept(pair, 0, real(1.0 / 60));
            if (!result.near) continue;
            EXPECT_NEAR(result.manifold.normal.y, 1, 1e-6) << "at x = " << x << " m, v = " << v << " m/s";
        }
    }
}

TEST(Swept, AnImpactIsTakenWhereTheSurfacesMeet)
{
    TRACES("IM3");
    const Convex wall = convexOf(makeBox(1, 4)), disc = convexOf(Circle{{}, real(0.5)});
    const SweptPair pair{wall, disc, path(0, 0, 0, 0, 0, 0), path(-3, 0, 0, 1000, 0, 0), real(1e-3)};
    const SweptResult result = collideSwept(pair, 0, real(1.0 / 60));
    ASSERT_TRUE(result.near);
    EXPECT_TRUE(result.manifold.atImpact);
    EXPECT_NEAR(result.manifold.time, 2.0 / 1000, 2e-6);  // 2 m to go
    EXPECT_NEAR(result.manifold.normal.x, -1, 1e-6);
}

TEST(Swept, TheBoundsHoldTheShapeAllTheWay)
{
    TRACES("R7");
    std::mt19937 random(12);
    std::uniform_real_distribution<double> place(-3, 3), speed(-100, 100), spin(-100, 100);
    for (int trial = 0; trial < 300; ++trial) {
        const Convex shape = convexOf(kMovers[random() % 5]);
        const Trajectory way =
            path(place(random), place(random), 1, speed(random), speed(random), spin(random));
        const real dt = real(1.0 / 60);
        const Aabb box = sweptBounds(shape, way, {}, 0, dt, real(1e-4));
        for (int i = 0; i <= 50; ++i) {
            const PlacedCore core(shape, way.at(dt * real(i) / 50));
            for (int k = 0; k < core.count; ++k) {
                const double x = static_cast<double>(core.vertices[k].x),
                             y = static_cast<double>(core.vertices[k].y);
                const double r = static_cast<double>(shape.radius);
                EXPECT_TRUE(box.lower.x <= x - r && x + r <= box.upper.x && box.lower.y <= y - r &&
                            y + r <= box.upper.y)
                    << "trial " << trial << ", vertex " << k << " at (" << x << ", " << y << ")";
            }
        }
    }
}

}  // namespace
}  // namespace tamias2d
