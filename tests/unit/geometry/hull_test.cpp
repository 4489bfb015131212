// SPDX-License-Identifier: MIT
#include "support/traces.hpp"
#include "unit/geometry/geometry_samples.hpp"

#include <tamias2d/base/error.hpp>
#include <tamias2d/geometry/hull.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace tamias2d::test {
namespace {

double turn(Vec2 a, Vec2 b, Vec2 c)
{
    return cross(toDVec2(b) - toDVec2(a), toDVec2(c) - toDVec2(a));
}

// The definition, at O(n^3): (a, b) is an edge of the hull if nothing lies right of it and nothing on its
// line lies beyond it. Corners are the starts of such edges.
std::vector<Vec2> hullByDefinition(const std::vector<Vec2>& points)
{
    std::vector<Vec2> corners;
    for (const Vec2 a : points) {
        for (const Vec2 b : points) {
            if (a == b) continue;
            const bool isEdge = std::all_of(points.begin(), points.end(), [&](Vec2 p) {
                const double side = turn(a, b, p);
                const DVec2 way = toDVec2(b) - toDVec2(a), to = toDVec2(p) - toDVec2(a);
                return side > 0 || (side == 0 && dot(to, way) >= 0 && dot(to, to) <= dot(way, way));
            });
            if (isEdge && std::find(corners.begin(), corners.end(), a) == corners.end()) corners.push_back(a);
        }
    }
    std::sort(corners.begin(), corners.end(),
              [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    return corners;
}

// Few places on a coarse grid: many points coincide and many lie on one line.
TEST(Hull, OfRandomPointsIsTheOneOfTheDefinition)
{
    TRACES("T5");
    RandomPoints random(1);
    for (int round = 0; round < 300; ++round) {
        std::vector<Vec2> points;
        const double grid = round % 3 == 0 ? 3 : 1000;
        for (int i = 0; i < 5 + round % 20; ++i)
            points.push_back(vec(std::floor(random.number(grid)), std::floor(random.number(grid))));

        std::vector<Vec2> hull = convexHull(points);
        const std::vector<Vec2> expected = hullByDefinition(points);
        ASSERT_EQ(hull.size(), expected.size()) << "round " << round;
        for (std::size_t i = 0; hull.size() > 2 && i < hull.size(); ++i)
            ASSERT_GT(turn(hull[i], hull[(i + 1) % hull.size()], hull[(i + 2) % hull.size()]), 0)
                << "round " << round;
        ASSERT_EQ(hull.front(), expected.front()) << "starts at the lowest of the leftmost";
        std::sort(hull.begin(), hull.end(),
                  [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
        ASSERT_EQ(hull, expected) << "round " << round;
    }
}

TEST(Hull, OfPointsOnALineIsItsEnds)
{
    TRACES("T5");
    const std::vector<Vec2> line = {vec(1, 1), vec(0, 0), vec(3, 3), vec(2, 2), vec(0, 0)};
    EXPECT_EQ(convexHull(line), (std::vector<Vec2>{vec(0, 0), vec(3, 3)}));
}

TEST(Hull, OfOnePlaceIsThatPlace)
{
    TRACES("T5");
    EXPECT_TRUE(convexHull({}).empty());
    const std::vector<Vec2> same = {vec(2, 1), vec(2, 1), vec(2, 1)};
    EXPECT_EQ(convexHull(same), (std::vector<Vec2>{vec(2, 1)}));
}

TEST(Hull, RefusesWhatIsNoNumber)
{
    TRACES("R4");
    std::vector<Vec2> points = {vec(0, 0), vec(1, 0), vec(0, 1)};
    points[1].y = std::numeric_limits<real>::quiet_NaN();
    try {
        convexHull(points);
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "convexHull.points[1] = (1, nan): must be finite");
    }
}

}  // namespace
}  // namespace tamias2d::test
