// SPDX-License-Identifier: MIT
#include "geometry/cast.hpp"
#include "support/traces.hpp"
#include "unit/geometry/geometry_samples.hpp"

#include <tamias2d/geometry/mass.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace tamias2d::test {
namespace {

TEST(Points, AreInAShapeIfTheirDistanceSaysSo)
{
    TRACES("T5", "R7");
    RandomPoints random(1);
    for (const Geometry& shape : sampleShapes()) {
        int inside = 0;
        for (int i = 0; i < 20000; ++i) {
            const DVec2 p = random.point(2);
            const double distance = distanceFrom(shape, p);
            if (std::abs(distance) < 1e-9) continue;  // rounding decides there
            ASSERT_EQ(containsPoint(shape, toVec2(p)), distance < 0)
                << shape.index() << ": " << p.x << ' ' << p.y;
            inside += distance < 0;
        }
        EXPECT_TRUE(inside > 100 || double(area(shape)) == 0) << "kind " << shape.index();
    }
}

TEST(Points, OnTheBorderAreInTheShape)
{
    TRACES("T5");
    const Geometry box = makeBox(2, 1);
    for (const Vec2 p : {vec(1, 0.5), vec(1, 0), vec(0.3, -0.5), vec(-1, -0.5)})
        EXPECT_TRUE(containsPoint(box, p));
    EXPECT_TRUE(containsPoint(Circle{{}, 5}, vec(3, 4)));
    EXPECT_TRUE(containsPoint(Segment{vec(0, 0), vec(2, 0), 0}, vec(2, 0)));
    EXPECT_FALSE(containsPoint(Segment{vec(0, 0), vec(2, 0), 0}, vec(1, 0.001)));
}

// Walks the ray by the distance left, which cannot overshoot; stops within 1e-10 of the surface.
std::optional<double> marchedFraction(const Geometry& shape, DVec2 from, DVec2 to)
{
    const double reach = length(to - from);
    const DVec2 direction = (1 / reach) * (to - from);
    double way = 0;
    for (int i = 0; i < 100000 && way <= reach; ++i) {
        const double gap = distanceFrom(shape, from + way * direction);
        if (gap < 1e-10) return way / reach;
        way += gap;
    }
    return std::nullopt;
}

TEST(Rays, HitWhereMarchingAlongThemDoes)
{
    TRACES("R7", "T5");
    RandomPoints random(2);
    for (const Geometry& shape : sampleShapes()) {
        int hits = 0;
        for (int i = 0; i < 3000; ++i) {
            const DVec2 from = random.point(4), to = random.point(4);
            const auto hit = castRay(shape, from, to);
            const auto expected = marchedFraction(shape, from, to);
            if (!hit && expected) {
                // Marching takes for a hit what passes within 1e-10; a hair longer a ray must really miss.
                const DVec2 at = from + *expected * (to - from);
                ASSERT_GT(distanceFrom(shape, at), 0) << "missed";
                continue;
            }
            ASSERT_EQ(hit.has_value(), expected.has_value())
                << shape.index() << ": " << from.x << ' ' << from.y << " to " << to.x << ' ' << to.y;
            if (!hit) continue;
            ++hits;
            const DVec2 at = from + hit->fraction * (to - from);
            ASSERT_LE(hit->fraction, 1);
            if (distanceFrom(shape, from) < 0) {
                ASSERT_EQ(hit->fraction, 0);
                ASSERT_EQ(hit->normal, DVec2{});
                continue;
            }
            ASSERT_NEAR(distanceFrom(shape, at), 0, 1e-12) << "the point must be on the surface";
            ASSERT_GE(hit->fraction, *expected - 1e-12) << "nothing may be skipped";
            ASSERT_NEAR(length(hit->normal), 1, 1e-12);
            ASSERT_LT(dot(hit->normal, to - from), 0) << "the normal must face the ray";
            ASSERT_GT(distanceFrom(shape, at + 1e-3 * hit->normal), 0.99e-3) << "and point straight away";
        }
        EXPECT_GT(hits, 300) << "kind " << shape.index();
    }
}

TEST(Rays, MeetDiscAndBoxAsByHand)
{
    TRACES("R7");
    const auto disc = castRay(Circle{vec(1, 0), real(0.5)}, {-1, 0}, {3, 0});
    ASSERT_TRUE(disc);
    EXPECT_DOUBLE_EQ(disc->fraction, 1.5 / 4);
    EXPECT_EQ(disc->normal, (DVec2{-1, 0}));
    const auto rounded = castRay(makeBox(2, 2, real(0.5)), {0.25, 4}, {0.25, 0});
    ASSERT_TRUE(rounded);
    EXPECT_DOUBLE_EQ(rounded->fraction, 2.5 / 4);
    EXPECT_EQ(rounded->normal, (DVec2{0, 1}));
}

TEST(Rays, ThatEndShortOrPointAwayMiss)
{
    TRACES("R7");
    for (const Geometry& shape :
         {Geometry(Circle{}), Geometry(makeBox(1, 1)), Geometry(makeBox(1, 1, real(0.1)))}) {
        EXPECT_FALSE(castRay(shape, {-5, 0}, {-1, 0}));
        EXPECT_FALSE(castRay(shape, {-5, 0}, {-9, 0}));
        EXPECT_FALSE(castRay(shape, {-5, 0}, {-5, 0})) << "a ray without length";
    }
}

TEST(Rays, OntoACornerNeverSlipThrough)
{
    TRACES("R7");
    RandomPoints random(3);
    for (const double radius : {0.0, 0.25}) {
        const Polygon shape = makeRegularPolygon(7, 1, static_cast<real>(radius));
        for (int i = 0; i < 20000; ++i) {
            const DVec2 corner = toDVec2(shape.points()[static_cast<std::size_t>(i % 7)]);
            const DVec2 from = corner + 3.0 * corner + random.point(1);
            ASSERT_TRUE(castRay(shape, from, {0, 0}));
            ASSERT_TRUE(castRay(shape, from, from + 1.5 * (corner - 1e-12 * corner - from))) << i;
        }
    }
}

TEST(Rays, HitALineFromBothSidesAndEndOn)
{
    TRACES("R7");
    const Geometry line = Segment{vec(-1, 0), vec(1, 0), 0};
    EXPECT_EQ(castRay(line, {0, 1}, {0, -1}).value().normal, (DVec2{0, 1}));
    EXPECT_EQ(castRay(line, {0, -1}, {0, 1}).value().normal, (DVec2{0, -1}));
    const auto along = castRay(line, {3, 0}, {-3, 0});
    ASSERT_TRUE(along);
    EXPECT_DOUBLE_EQ(along->fraction, 2.0 / 6);
    EXPECT_EQ(along->normal, (DVec2{1, 0}));
}

struct Placed {
    Position origin;
    double angle;
    Rot rotation;
};

Placed randomPlace(RandomPoints& random)
{
    const double angle = random.number(7);
    return {{random.number(2), random.number(2)}, angle, Rot::ofAngle(angle)};
}

DVec2 localPoint(const Placed& place, Position p)
{
    const DVec2 d = p - place.origin;
    const double c = double(place.rotation.c), s = double(place.rotation.s);
    return {c * d.x + s * d.y, c * d.y - s * d.x};
}

// The distance of the shape from the box: a convex function on the box, so nested searches find its least.
double distanceFromBox(const Geometry& shape, const Placed& place, const Aabb& box)
{
    const auto at = [&](double x, double y) { return distanceFrom(shape, localPoint(place, {x, y})); };
    const auto least = [](double low, double high, auto&& f) {
        for (int i = 0; i < 60; ++i) {
            const double a = low + (high - low) / 3, b = high - (high - low) / 3;
            if (f(a) < f(b))
                high = b;
            else
                low = a;
        }
        return std::min({f(low), f(high), f((low + high) / 2)});
    };
    return least(box.lower.x, box.upper.x, [&](double x) {
        return least(box.lower.y, box.upper.y, [&](double y) { return at(x, y); });
    });
}

TEST(Boxes, OverlapAShapeIfTheirDistanceSaysSo)
{
    TRACES("R7", "T5");
    RandomPoints random(4);
    for (const Geometry& shape : sampleShapes()) {
        int overlaps = 0, near = 0;
        for (int i = 0; i < 60; ++i) {
            const Placed place = randomPlace(random);
            const DVec2 middle = random.point(3);
            const double w = 0.1 + std::abs(random.number(1)), h = 0.1 + std::abs(random.number(1));
            const Aabb box{{middle.x - w, middle.y - h}, {middle.x + w, middle.y + h}};
            const double distance = distanceFromBox(shape, place, box);
            const bool given = overlapsBox(shape, place.origin, place.rotation, box);
            // The search is no better than this; a line is never nearer than 0.
            constexpr double kBlur = 1e-6;
            if (std::abs(distance) < kBlur && double(area(shape)) > 0) continue;
            ASSERT_EQ(given, distance < kBlur) << shape.index() << ": " << distance;
            overlaps += given;
            near += !given && distance < 0.5;
        }
        EXPECT_GT(overlaps, 5) << "kind " << shape.index();
        EXPECT_GT(near, 2) << "kind " << shape.index();
    }
}

TEST(Boxes, AtARoundedCornerSeeTheRounding)
{
    TRACES("R7");
    const Geometry shape = makeBox(2, 2, 1);  // the corner's disc reaches 1 + sqrt(1/2) along the diagonal
    const double rim = 1 + std::sqrt(0.5);
    const auto boxFrom = [](double corner) { return Aabb{{corner, corner}, {5, 5}}; };
    EXPECT_TRUE(overlapsBox(shape, {}, {}, boxFrom(rim - 1e-9)));
    EXPECT_FALSE(overlapsBox(shape, {}, {}, boxFrom(rim + 1e-9)));
}

TEST(Boxes, TouchCounts)
{
    TRACES("T5");
    EXPECT_TRUE(overlapsBox(makeBox(2, 2), {}, {}, {{1, -3}, {2, 3}}));
    EXPECT_TRUE(overlapsBox(Circle{{}, 1}, {}, {}, {{1, 0}, {2, 3}}));
    EXPECT_TRUE(overlapsBox(makeBox(2, 2), {}, {}, {{-0.1, -0.1}, {0.1, 0.1}})) << "all inside";
    EXPECT_TRUE(overlapsBox(makeBox(2, 2), {}, {}, {{0.5, 0.5}, {0.5, 0.5}})) << "a box without size";
}

// The least box: nothing of the shape is outside, and each side is reached.
TEST(Boxes, AroundAShapeFitTightly)
{
    TRACES("R7");
    RandomPoints random(5);
    for (const Geometry& shape : sampleShapes()) {
        for (int i = 0; i < 20; ++i) {
            const Placed place = randomPlace(random);
            const Aabb box = boundsOf(shape, place.origin, place.rotation);
            constexpr double kFar = 10, kHair = 1e-6;
            const Aabb sides[] = {{{-kFar, -kFar}, {box.lower.x, kFar}},
                                  {{box.upper.x, -kFar}, {kFar, kFar}},
                                  {{-kFar, -kFar}, {kFar, box.lower.y}},
                                  {{-kFar, box.upper.y}, {kFar, kFar}}};
            for (const Aabb& side : sides) {
                const double distance = distanceFromBox(shape, place, side);
                ASSERT_NEAR(distance, 0, kHair) << "kind " << shape.index();
            }
        }
    }
}

}  // namespace
}  // namespace tamias2d::test
