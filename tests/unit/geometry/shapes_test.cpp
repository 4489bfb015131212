// SPDX-License-Identifier: MIT
#include "geometry/validate.hpp"
#include "support/traces.hpp"
#include "unit/geometry/geometry_samples.hpp"

#include <tamias2d/geometry/mass.hpp>
#include <tamias2d/math/scalar.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace tamias2d::test {
namespace {

TEST(Shapes, ABoxIsAsWideAndHighAsAsked)
{
    TRACES("R2");
    const Polygon box = makeBox(3, 1, real(0.25));
    ASSERT_EQ(box.count, 4);
    EXPECT_EQ(box.radius, real(0.25));
    const std::vector<Vec2> expected = {vec(-1.5, -0.5), vec(1.5, -0.5), vec(1.5, 0.5), vec(-1.5, 0.5)};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(box.points()[i], expected[i]) << i;
}

TEST(Shapes, ARegularPolygonHasItsCornersOnACircleFromAngleZero)
{
    TRACES("R2");
    for (int count = 3; count <= kMaxPolygonVertices; ++count) {
        const Polygon p = makeRegularPolygon(count, 2);
        ASSERT_EQ(p.count, count);
        for (int i = 0; i < count; ++i) {
            const double angle = 2 * kPi * i / count;
            EXPECT_NEAR(double(p.vertices[std::size_t(i)].x), 2 * std::cos(angle), 2 * kRealTolerance);
            EXPECT_NEAR(double(p.vertices[std::size_t(i)].y), 2 * std::sin(angle), 2 * kRealTolerance);
        }
        EXPECT_FALSE(checkGeometry("polygon", p));
    }
}

TEST(Shapes, APolygonOrdersItsPoints)
{
    TRACES("R2");
    const std::vector<Vec2> shuffled = {vec(1, 1), vec(0, 0), vec(0.5, 0.5),
                                        vec(0, 1), vec(1, 0), vec(0.5, 0)};
    const Polygon p = makePolygon(shuffled, real(0.1));
    ASSERT_EQ(p.count, 4) << "the middle and the point on an edge are no corners";
    EXPECT_EQ(p.radius, real(0.1));
    EXPECT_FALSE(checkGeometry("polygon", p));
    EXPECT_NEAR(double(area(makePolygon(shuffled))), 1, kRealTolerance);
}

// 0.1, 0.2 and 0.3 are not evenly spaced in binary, but a straight edge was meant.
TEST(Shapes, APolygonTakesNoCornerThatIsOnlyRounding)
{
    TRACES("R4");
    for (double angle = 0.05; angle < 6; angle += 0.1) {
        std::vector<Vec2> points = {vec(3 * std::sin(angle), -3 * std::cos(angle))};
        for (int i = -10; i <= 10; ++i)
            points.push_back(vec(0.1 * i * std::cos(angle), 0.1 * i * std::sin(angle)));
        EXPECT_EQ(makePolygon(points).count, 3) << angle;
    }
}

TEST(Shapes, WhateverThePointsAPolygonIsValidOrExplained)
{
    TRACES("R4");
    RandomPoints random(5);
    int made = 0;
    for (int round = 0; round < 3000; ++round) {
        std::vector<Vec2> points;
        const double flat = std::pow(10.0, -(round % 20));  // down to far less than rounding
        for (int i = 0; i < 3 + round % 10; ++i)
            points.push_back(vec(random.number(1), flat * random.number(1)));
        try {
            const Polygon p = makePolygon(points);
            ++made;
            const Complaint wrong = checkGeometry("polygon", p);
            ASSERT_FALSE(wrong) << wrong->what();
        } catch (const InputError& error) {
            ASSERT_EQ(error.field, "makePolygon.points");
        }
    }
    EXPECT_GT(made, 500);
}

struct Refusal {
    std::function<void()> call;
    std::string text;
};

TEST(Shapes, TheMakersExplainWhatTheyRefuse)
{
    TRACES("R4");
    const real nan = std::numeric_limits<real>::quiet_NaN();
    const std::vector<Vec2> two = {vec(0, 0), vec(1, 0)}, same = {vec(1, 2), vec(1, 2), vec(1, 2)},
                            line = {vec(0, 0), vec(1, 1), vec(2, 2)}, bad = {vec(0, 0), {nan, 0}, vec(0, 1)};
    std::vector<Vec2> ring;
    for (int i = 0; i < 40; ++i) ring.push_back(vec(std::cos(i * kTwoPi / 40), std::sin(i * kTwoPi / 40)));
    const std::vector<Refusal> cases = {
        {[] { makeBox(-1, 2); }, "makeBox.width = -1: must be finite and > 0 m"},
        {[=] { makeBox(1, nan); }, "makeBox.height = nan: must be finite and > 0 m"},
        {[] { makeBox(1, 1, real(-0.5)); }, "makeBox.radius = -0.5: must be finite and in [0, 1e+50] m"},
        {[] { makeRegularPolygon(2, 1); }, "makeRegularPolygon.count = 2: must be in [3, 16]"},
        {[] { makeRegularPolygon(5, 0); }, "makeRegularPolygon.circumradius = 0: must be finite and > 0 m"},
        {[=] { makePolygon(two); }, "makePolygon.points = [(0, 0), (1, 0)]: must be at least 3 points"},
        {[=] { makePolygon(same); },
         "makePolygon.points = [(1, 2), (1, 2), (1, 2)]: must be at least 3 different points; all are one"},
        {[=] { makePolygon(line); },
         "makePolygon.points = [(0, 0), (1, 1), (2, 2)]: must not all lie on one line"},
        {[=] { makePolygon(bad); }, "makePolygon.points[1] = (nan, 0): must be finite"},
        {[=] { makePolygon(ring); },
         "makePolygon.points = 40 points: must have at most 16 corners in its hull; it has 40"},
    };
    for (const Refusal& refusal : cases) {
        try {
            refusal.call();
            ADD_FAILURE() << "accepted, instead of: " << refusal.text;
        } catch (const InputError& error) {
            EXPECT_EQ(error.what(), refusal.text);
        }
    }
}

TEST(Shapes, ACheckOfAShapeNamesThePartAndTheRule)
{
    TRACES("R4");
    const real inf = std::numeric_limits<real>::infinity();
    const auto polygon = [](std::vector<Vec2> v) { return Geometry(rawPolygon(v)); };
    Polygon tooMany = makeBox(1, 1), star;
    tooMany.count = 17;
    for (int i = 0; i < 5; ++i)
        star.vertices[std::size_t(star.count++)] = vec(std::cos(i * 0.8 * kPi), std::sin(i * 0.8 * kPi));

    const std::vector<std::pair<Geometry, std::string>> cases = {
        {Circle{{0, inf}, 1}, "g.center = (0, inf): must be finite"},
        {Circle{vec(2e6, 0), 1},
         "g.center = (2e+06, 0): must be finite and each coordinate in [-1e+06, 1e+06] m"},
        {Circle{{}, 0}, "g.radius = 0: must be finite and in [1e-06, 1e+06] m"},
        {Circle{{}, -inf}, "g.radius = -inf: must be finite and in [1e-06, 1e+06] m"},
        {Capsule{{1, 1}, {1, 1}, 1}, "g.b = (1, 1): must be at least 1e-06 m from a"},
        {Segment{{}, {1, 0}, -1}, "g.radius = -1: must be finite and in [0, 1e+06] m"},
        {Polygon{}, "g.count = 0: must be in [3, 16]"},
        {tooMany, "g.count = 17: must be in [3, 16]"},
        {polygon({vec(0, 0), vec(1, 0), {0, inf}}), "g.vertices[2] = (0, inf): must be finite"},
        {polygon({vec(0, 0), vec(1, 0), vec(1, 0), vec(0, 1)}),
         "g.vertices[2] = (1, 0): must be at least 1e-06 m from vertices[1]"},
        {polygon({vec(0, 0), vec(1, 0), vec(2, 0)}),
         "g.vertices = [(0, 0), (1, 0), (2, 0)]: must not all lie on one line"},
        {polygon({vec(0, 0), vec(0, 1), vec(1, 0)}),
         "g.vertices = [(0, 0), (0, 1), (1, 0)]: must be in counter-clockwise order"},
        {polygon({vec(0, 0), vec(1, 0), vec(0.25, 0.25), vec(0, 1)}),
         "g.vertices[2] = (0.25, 0.25): must be a corner of a convex polygon; it turns right (makePolygon "
         "keeps the corners of the hull)"},
        {polygon({vec(0, 0), vec(1, 0), vec(2, 0), vec(0, 1)}),
         "g.vertices[1] = (1, 0): must be a corner of a convex polygon; it lies on the line of its "
         "neighbours (makePolygon keeps the corners of the hull)"},
    };
    for (const auto& [shape, text] : cases) {
        const Complaint wrong = checkGeometry("g", shape, 1e-6, 1e6);
        ASSERT_TRUE(wrong) << "accepted, instead of: " << text;
        EXPECT_EQ(wrong->what(), text);
    }
    const auto ruleOf = [](const Geometry& g) { return checkGeometry("g", g, 1e-6, 1e6).value().rule; };
    EXPECT_EQ(ruleOf(star), "must go around once; its edges cross");
    EXPECT_EQ(ruleOf(polygon({vec(0, 0), vec(1, 0), vec(0.5, 1e-7)})).substr(0, 30),
              "must be at least 1e-06 m thick");
}

TEST(Shapes, OfEveryKindPassTheirCheck)
{
    TRACES("R4");
    for (const Geometry& shape : sampleShapes()) {
        const Complaint wrong = checkGeometry("g", shape, 1e-6, 1e6);
        EXPECT_FALSE(wrong) << wrong->what();
    }
}

}  // namespace
}  // namespace tamias2d::test
