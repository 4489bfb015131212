// SPDX-License-Identifier: MIT
#include "narrowphase/manifold.hpp"
#include "support/convex.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace tamias2d {
namespace {

using test::convexOf;

constexpr double kDistanceTolerance =
    std::is_same_v<real, double> ? 1e-12 : 2e-5;  // rounding at a few meters

Pose poseAt(double x, double y, double angle)
{
    return {{static_cast<real>(x), static_cast<real>(y)}, Rot::ofAngle(angle)};
}

double pointToSegment(DVec2 p, DVec2 a, DVec2 b)
{
    const DVec2 ab = b - a;
    const double squared = dot(ab, ab);
    const double t = squared > 0 ? std::min(1.0, std::max(0.0, dot(p - a, ab) / squared)) : 0.0;
    return length(p - (a + t * ab));
}

// The distance of two disjoint convex cores is that of a vertex of one to an edge of the other.
double distanceByDefinition(const PlacedCore& a, const PlacedCore& b)
{
    double least = std::numeric_limits<double>::max();
    const auto measure = [&](const PlacedCore& points, const PlacedCore& edges) {
        for (int i = 0; i < points.count; ++i)
            for (int k = 0; k < edges.count; ++k)
                least =
                    std::min(least, pointToSegment(toDVec2(points.vertices[i]), toDVec2(edges.vertices[k]),
                                                   toDVec2(edges.vertices[edges.next(k)])));
    };
    measure(a, b);
    measure(b, a);
    return least;
}

const Geometry kCores[] = {Circle{{}, real(0.5)},
                           Capsule{{real(-0.6), 0}, {real(0.6), real(0.1)}, real(0.2)},
                           Segment{{-1, 0}, {1, real(0.2)}, 0},
                           makeBox(1, real(0.6)),
                           makeBox(1, 1, real(0.1)),
                           makeRegularPolygon(7, real(0.8))};

// Lanes reckon with several faces and vertices at once.
TEST(Separation, OfFacesHasTheBitsOfEachFaceAlone)
{
    TRACES("ADR6", "T5");
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-3, 3), turn(0, kTwoPi);
    for (int trial = 0; trial < 4000; ++trial) {
        const int corners = 3 + static_cast<int>(random() % 14);
        const Convex a = convexOf(makeRegularPolygon(corners, real(0.7))), b = convexOf(kCores[random() % 6]);
        const Pose poseA = poseAt(place(random), place(random), turn(random));
        const Pose poseB = poseAt(place(random), place(random), turn(random));
        const PlacedCore coreA(a, poseA), coreB(b, poseB);
        const FaceDistances distances(coreA, coreB);
        for (int i = 0; i < corners; ++i) {
            const Vec2 vertex = poseA.p + rotate(poseA.q, a.vertices[static_cast<std::size_t>(i)]);
            const Vec2 normal = rotate(poseA.q, a.normals[static_cast<std::size_t>(i)]);
            EXPECT_EQ(coreA.vertices[i], vertex) << "trial " << trial;
            EXPECT_EQ(coreA.normals[i], normal) << "trial " << trial;
            real least = std::numeric_limits<real>::max();
            for (int k = 0; k < b.count; ++k)
                least = std::min(
                    least,
                    dot(normal, poseB.p + rotate(poseB.q, b.vertices[static_cast<std::size_t>(k)]) - vertex));
            EXPECT_EQ(distances[i], least) << "trial " << trial << ", face " << i;
        }
    }
}

TEST(Separation, OfShapesApartIsTheDistanceOfTheirNearestPoints)
{
    TRACES("T5", "LC1");
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-3, 3), turn(0, kTwoPi);
    int apart = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const Convex a = convexOf(kCores[random() % 6]), b = convexOf(kCores[random() % 6]);
        const Pose poseA = poseAt(place(random), place(random), turn(random));
        const Pose poseB = poseAt(place(random), place(random), turn(random));
        const PlacedCore coreA(a, poseA), coreB(b, poseB);
        const Separation s = exactSeparation({coreA, coreB}, 0);
        if (s.distance <= 1e-3) continue;  // overlapping cores have no distance
        ++apart;
        const double expected = distanceByDefinition(coreA, coreB);
        EXPECT_NEAR(s.distance, expected, kDistanceTolerance) << "trial " << trial;
        EXPECT_NEAR(length(s.normal), 1, kDistanceTolerance) << "trial " << trial;
    }
    EXPECT_GT(apart, 2500);
}

TEST(Separation, ByFacesIsNeverMoreThanTheDistance)
{
    TRACES("T5");
    std::mt19937 random(4);
    std::uniform_real_distribution<double> place(-2, 2), turn(0, kTwoPi);
    const Convex a = convexOf(makeBox(1, real(0.6))), b = convexOf(makeRegularPolygon(5, real(0.7)));
    for (int trial = 0; trial < 2000; ++trial) {
        const PlacedCore coreA(a, poseAt(place(random), place(random), turn(random)));
        const PlacedCore coreB(b, poseAt(place(random), place(random), turn(random)));
        const double byFaces = separationByFaces({coreA, coreB}, 0).distance;
        if (byFaces > 0) {
            EXPECT_LE(byFaces, distanceByDefinition(coreA, coreB) + kDistanceTolerance) << "trial " << trial;
        }
    }
}

TEST(Separation, ChangesSignWhenTheShapesAreSwapped)
{
    TRACES("T2");
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-2, 2), turn(0, kTwoPi);
    for (int trial = 0; trial < 2000; ++trial) {
        const Convex a = convexOf(kCores[random() % 6]), b = convexOf(kCores[random() % 6]);
        const PlacedCore coreA(a, poseAt(place(random), place(random), turn(random)));
        const PlacedCore coreB(b, poseAt(place(random), place(random), turn(random)));
        const Separation ab = exactSeparation({coreA, coreB}, 0), ba = exactSeparation({coreB, coreA}, 0);
        EXPECT_NEAR(ab.distance, ba.distance, kDistanceTolerance) << "trial " << trial;
    }
}

TEST(Separation, LinesOnOneAnothersExtensionAreApart)
{
    TRACES("T5");
    const Convex line = convexOf(Segment{{0, 0}, {1, 0}, 0});
    const Separation s =
        exactSeparation({PlacedCore(line, poseAt(0, 0, 0)), PlacedCore(line, poseAt(3, 0, 0))}, 0);
    EXPECT_NEAR(s.distance, 2, kDistanceTolerance);
    EXPECT_NEAR(s.normal.x, 1, kDistanceTolerance);
}

// On a lattice of eighths all is exact, and cores often meet just so: the line of a capsule in the edge of a
// blade, an end of it in a corner.
TEST(Separation, TheNormalLeadsFromTheOneToTheOtherEvenIfTheirCoresMeet)
{
    TRACES("T5", "LC1");
    const Convex cores[] = {
        convexOf(Circle{{}, real(0.25)}), convexOf(Capsule{{real(-0.25), 0}, {real(0.25), 0}, real(0.25)}),
        convexOf(Segment{{0, real(-0.5)}, {0, real(0.5)}, 0}), convexOf(makeBox(real(0.75), 2, real(0.125))),
        convexOf(makeBox(real(0.5), real(0.25)))};
    const Rot quarters[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    std::mt19937 random(6);
    const auto place = [&random] { return static_cast<real>(static_cast<int>(random() % 17) - 8) / 8; };
    int meet = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Convex &a = cores[random() % 5], &b = cores[random() % 5];
        const PlacedCore coreA(a, Pose{{place(), place()}, quarters[random() % 4]});
        const PlacedCore coreB(b, Pose{{place(), place()}, quarters[random() % 4]});
        const Separation s = exactSeparation({coreA, coreB}, 0);
        if (s.distance < 0 || a.count + b.count == 2) continue;  // two centers in one place have no direction
        meet += s.distance == 0 ? 1 : 0;
        real endOfA = -std::numeric_limits<real>::max(), startOfB = std::numeric_limits<real>::max();
        for (int i = 0; i < coreA.count; ++i) endOfA = std::max(endOfA, dot(s.normal, coreA.vertices[i]));
        for (int i = 0; i < coreB.count; ++i) startOfB = std::min(startOfB, dot(s.normal, coreB.vertices[i]));
        EXPECT_NEAR(startOfB - endOfA, s.distance, kDistanceTolerance)
            << "trial " << trial << ": normal (" << s.normal.x << ", " << s.normal.y << ")";
    }
    EXPECT_GT(meet, 1000);
}

TEST(Manifold, OfABoxOnABoxHasTheEndsOfTheSharedEdge)
{
    TRACES("LC1", "IM3");
    const Convex wide = convexOf(makeBox(4, 1)), small = convexOf(makeBox(1, 1));
    const Pose below = poseAt(0, 0, 0), above = poseAt(1.8, 1.001, 0);
    Manifold m;
    closestManifold({wide, below, small, above}, real(1e-4), m);
    ASSERT_EQ(m.count, 2);
    EXPECT_NEAR(m.normal.y, 1, kDistanceTolerance);
    const double x0 = static_cast<double>(m.points[0].localA.x),
                 x1 = static_cast<double>(m.points[1].localA.x);
    EXPECT_NEAR(std::min(x0, x1), 1.3, kDistanceTolerance);  // the small box's left corner
    EXPECT_NEAR(std::max(x0, x1), 2.0, kDistanceTolerance);  // the wide box's right corner
}

TEST(Manifold, OfADiscAndACornerPointsAwayFromTheCorner)
{
    TRACES("LC1", "A5");
    const Convex square = convexOf(makeBox(2, 2)), disc = convexOf(Circle{{}, real(0.5)});
    Manifold m;
    closestManifold({square, poseAt(0, 0, 0), disc, poseAt(1.4, 1.4, 0.3)}, real(1e-4), m);
    ASSERT_EQ(m.count, 1);
    EXPECT_NEAR(m.normal.x, std::sqrt(0.5), kDistanceTolerance);
    EXPECT_NEAR(m.normal.y, std::sqrt(0.5), kDistanceTolerance);
    EXPECT_NEAR(m.points[0].localA.x, 1, kDistanceTolerance);
    EXPECT_NEAR(m.points[0].localB.x, 0, kDistanceTolerance);
}

}  // namespace
}  // namespace tamias2d
