// SPDX-License-Identifier: MIT
// Points, boxes and rays: answers at the present poses, sorted, filtered, exact to the shape [R7].
#include "support/build.hpp"
#include "support/overlap.hpp"
#include "support/random.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace tamias2d {
namespace {

using namespace test;

// A row of one of each: disc at 0, box at 3, capsule at 6, hexagon at 9, wall segment at 12; all 2 m high.
struct Row {
    World world;
    Body disc = addDisc(world, {0, 0}, 1);
    Body box = addBox(world, {3, 0}, 2, 2);
    Body capsule = addBody(world, {6, 0}, Capsule{vec(0, -0.5), vec(0, 0.5), toReal(0.5)});
    Body rounded = addBox(world, {9, 0}, 2, 2, {.rounding = 0.25});
    Body wall = addBody(world, {12, 0}, Segment{vec(0, -1), vec(0, 1)}, {.type = BodyType::Static});

    ShapeId shapeOf(const Body& body) const { return body.shapes().front().id(); }
    std::vector<ShapeId> all() const
    {
        return {shapeOf(disc), shapeOf(box), shapeOf(capsule), shapeOf(rounded), shapeOf(wall)};
    }
};

TEST(PointQuery, FindsTheShapesThatHoldIt)
{
    TRACES("R7", "T5");
    Row row;
    EXPECT_EQ(row.world.queryPoint({0.5, 0.5}), (std::vector<ShapeId>{row.shapeOf(row.disc)}));
    EXPECT_TRUE(row.world.queryPoint({0.8, 0.8}).empty()) << "in the disc's box, not in the disc";
    EXPECT_EQ(row.world.queryPoint({3.9, 0.9}), (std::vector<ShapeId>{row.shapeOf(row.box)}));
    EXPECT_TRUE(row.world.queryPoint({9.95, 0.95}).empty()) << "beyond the round corner";
    row.box.setTransform({0.5, 0}, 0);
    EXPECT_EQ(row.world.queryPoint({0.5, 0.5}),
              (std::vector<ShapeId>{row.shapeOf(row.disc), row.shapeOf(row.box)}));
    EXPECT_TRUE(row.world.queryPoint({3, 0}).empty()) << "a teleport counts at once";
    row.disc.setEnabled(false);
    EXPECT_EQ(row.world.queryPoint({0.5, 0.5}), (std::vector<ShapeId>{row.shapeOf(row.box)}));
}

TEST(BoxQuery, FindsTheShapesThatReachIn)
{
    TRACES("R7");
    Row row;
    EXPECT_EQ(row.world.queryBox({{-2, -2}, {13, 2}}), row.all());
    EXPECT_EQ(row.world.queryBox({{0.9, -0.1}, {2.1, 0.1}}),
              (std::vector<ShapeId>{row.shapeOf(row.disc), row.shapeOf(row.box)}));
    EXPECT_TRUE(row.world.queryBox({{0.8, 0.8}, {1.9, 2}}).empty()) << "near the disc, yet not in it";
    EXPECT_EQ(row.world.queryBox({{-0.1, -0.1}, {0.1, 0.1}}), (std::vector<ShapeId>{row.shapeOf(row.disc)}))
        << "wholly inside";
    EXPECT_EQ(row.world.queryBox({{11, -0.5}, {13, 0.5}}), (std::vector<ShapeId>{row.shapeOf(row.wall)}));
    EXPECT_EQ(row.world.queryBox({{3, 0}, {3, 0}}), (std::vector<ShapeId>{row.shapeOf(row.box)}))
        << "a point";
    row.box.setTransform({3, 0}, kPi / 4);
    EXPECT_TRUE(row.world.queryBox({{3.8, 0.8}, {4, 1}}).empty()) << "a turned box";
}

TEST(Ray, FindsTheFirstShape)
{
    TRACES("R7");
    Row row;
    const auto hit = row.world.castRay({-5, 0}, {15, 0});
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->shape, row.shapeOf(row.disc));
    EXPECT_EQ(hit->body, row.disc.id());
    EXPECT_NEAR(hit->fraction, 0.2, kExact);
    EXPECT_NEAR(hit->point.x, -1, kExact);
    EXPECT_NEAR(hit->point.y, 0, kExact);
    EXPECT_NEAR(hit->normal.x, -1, kExact);
    EXPECT_NEAR(hit->normal.y, 0, kExact);
    EXPECT_FALSE(row.world.castRay({-5, 0}, {-1.1, 0}).has_value()) << "it ends before";
    EXPECT_FALSE(row.world.castRay({-5, 2}, {15, 2}).has_value()) << "it passes above";
    EXPECT_FALSE(row.world.castRay({-5, 0}, {-15, 0}).has_value()) << "it looks away";
}

TEST(Ray, MeetsAShapeObliquely)
{
    TRACES("R7");
    Row row;
    // Down onto the disc at x = 0.6: it is met at (0.6, 0.8), where the normal is the same.
    const auto disc = row.world.castRay({0.6, 4}, {0.6, -4});
    ASSERT_TRUE(disc.has_value());
    EXPECT_NEAR(disc->point.y, 0.8, kExact);
    EXPECT_NEAR(disc->normal.x, 0.6, kExact);
    EXPECT_NEAR(disc->normal.y, 0.8, kExact);
    const auto box = row.world.castRay({2.5, 4}, {3.5, -4});
    ASSERT_TRUE(box.has_value());
    EXPECT_EQ(box->shape, row.shapeOf(row.box));
    EXPECT_NEAR(box->point.y, 1, kExact);
    EXPECT_NEAR(box->point.x, 2.875, kExact);
    EXPECT_NEAR(box->normal.y, 1, kExact);
    // The rounded corner of the box at 9: a quarter disc of 0.25 around (9.75, 0.75).
    const auto corner = row.world.castRay({9.75 + 0.15, 4}, {9.75 + 0.15, -4});
    ASSERT_TRUE(corner.has_value());
    EXPECT_NEAR(corner->point.y, 0.95, kExact);
    EXPECT_NEAR(corner->normal.x, 0.6, 10 * kExact);
    EXPECT_NEAR(corner->normal.y, 0.8, 10 * kExact);
    for (const double side : {1.0, -1.0}) {
        const auto wall = row.world.castRay({12 + side, 0.5}, {12 - side, 0.5});
        ASSERT_TRUE(wall.has_value()) << "a segment is solid from both sides";
        EXPECT_EQ(wall->shape, row.shapeOf(row.wall));
        EXPECT_NEAR(wall->normal.x, side, kExact);
    }
}

TEST(Ray, ThatStartsInsideHitsAtOnceWithoutANormal)
{
    TRACES("R7");
    Row row;
    const auto hit = row.world.castRay({3, 0}, {15, 0});
    ASSERT_TRUE(hit.has_value());
    EXPECT_EQ(hit->shape, row.shapeOf(row.box));
    EXPECT_EQ(hit->fraction, 0.0);
    EXPECT_EQ(hit->normal, vec(0, 0));
    const auto still = row.world.castRay({0, 0}, {0, 0});
    ASSERT_TRUE(still.has_value()) << "a ray of no length is a point";
    EXPECT_EQ(still->shape, row.shapeOf(row.disc));
    EXPECT_FALSE(row.world.castRay({1.5, 0}, {1.5, 0}).has_value());
}

TEST(Ray, FindsAllShapesInOrder)
{
    TRACES("R7");
    Row row;
    const auto hits = row.world.castRayAll({-5, 0}, {15, 0});
    std::vector<ShapeId> found;
    for (const RayHit& hit : hits) found.push_back(hit.shape);
    EXPECT_EQ(found, row.all());
    EXPECT_TRUE(std::is_sorted(hits.begin(), hits.end(),
                               [](const RayHit& a, const RayHit& b) { return a.fraction < b.fraction; }));
    const auto back = row.world.castRayAll({15, 0}, {-5, 0});
    ASSERT_EQ(back.size(), 5u);
    EXPECT_EQ(back.front().shape, row.shapeOf(row.wall));
    EXPECT_EQ(back.back().shape, row.shapeOf(row.disc));
}

TEST(Queries, ObeyFilters)
{
    TRACES("R7");
    Row row;
    row.disc.shapes().front().setFilter({.category = 2});
    const Filter notTwo{.category = 1, .mask = ~std::uint64_t{2}};
    EXPECT_TRUE(row.world.queryPoint({0, 0}, notTwo).empty());
    EXPECT_EQ(row.world.queryBox({{-2, -2}, {13, 2}}, notTwo).size(), 4u);
    EXPECT_EQ(row.world.castRay({-5, 0}, {15, 0}, notTwo)->shape, row.shapeOf(row.box));
    EXPECT_EQ(row.world.castRayAll({-5, 0}, {15, 0}, notTwo).size(), 4u);
    EXPECT_EQ(row.world.castRayAll({-5, 0}, {15, 0}, {.mask = 2}).size(), 1u);
}

TEST(Queries, ChangeNothing)
{
    TRACES("R7");
    Row row;
    row.world.step();
    const std::uint64_t hash = row.world.stateHash();
    row.world.queryPoint({0, 0});
    row.world.queryBox({{-2, -2}, {13, 2}});
    row.world.castRay({-5, 0}, {15, 0});
    row.world.castRayAll({-5, 0}, {15, 0});
    EXPECT_EQ(row.world.stateHash(), hash);
    World twin;
    EXPECT_TRUE(twin.queryPoint({0, 0}).empty());
    EXPECT_TRUE(twin.queryBox({{-1, -1}, {1, 1}}).empty());
    EXPECT_FALSE(twin.castRay({0, 0}, {1, 1}).has_value());
    EXPECT_TRUE(twin.castRayAll({0, 0}, {1, 1}).empty());
}

// Against plain geometry of the tests' own, on a field of 60 shapes.
TEST(Queries, AgreeWithAnIndependentMeasure)
{
    TRACES("R7", "T5");
    World world;
    Random random(3);
    for (int i = 0; i < 60; ++i) {
        const Position at = {random.between(-8, 8), random.between(-8, 8)};
        const Options options{.angle = random.between(0, 6), .rounding = i % 3 == 0 ? 0.1 : 0.0};
        if (i % 4 == 0)
            addDisc(world, at, random.between(0.2, 1), options);
        else if (i % 4 == 1)
            addBox(world, at, random.between(0.4, 2), random.between(0.4, 2), options);
        else if (i % 4 == 2)
            addCapsule(world, at, random.between(1, 2), 0.3, options);
        else
            addRegular(world, at, 3 + i % 7, random.between(0.3, 1), options);
    }
    std::vector<std::pair<ShapeId, Outline>> outlines;
    for (const BodyId id : world.bodies()) {
        const Shape shape = world.body(id).shapes().front();
        outlines.emplace_back(shape.id(), outlineInWorld(world, shape));
    }
    std::sort(outlines.begin(), outlines.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    const double unsure = 1e-5;  // [m]; nearer to a border than this, rounding decides
    for (int i = 0; i < 500; ++i) {
        const DVec2 p{random.between(-9, 9), random.between(-9, 9)};
        const DVec2 size{random.between(0, 2), random.between(0, 2)};
        Outline point{{p}, 0, p, 0}, box;
        box.core = {p, {p.x + size.x, p.y}, p + size, {p.x, p.y + size.y}};
        const auto inPoint = world.queryPoint({p.x, p.y});
        const auto inBox = world.queryBox({{p.x, p.y}, {p.x + size.x, p.y + size.y}});
        EXPECT_TRUE(std::is_sorted(inPoint.begin(), inPoint.end()));
        EXPECT_TRUE(std::is_sorted(inBox.begin(), inBox.end()));
        for (const auto& [id, outline] : outlines) {
            const double toPoint = gapBetween(outline, point), toBox = gapBetween(outline, box);
            const bool foundPoint = std::binary_search(inPoint.begin(), inPoint.end(), id);
            const bool foundBox = std::binary_search(inBox.begin(), inBox.end(), id);
            if (std::abs(toPoint) > unsure) {
                EXPECT_EQ(foundPoint, toPoint < 0) << "gap " << toPoint;
            }
            if (std::abs(toBox) > unsure) {
                EXPECT_EQ(foundBox, toBox < 0) << "gap " << toBox;
            }
        }
    }
}

TEST(Ray, ThatHitsEndsOnTheBorderAndNothingLiesBefore)
{
    TRACES("R7");
    World world;
    Random random(8);
    for (int i = 0; i < 40; ++i) {
        addRegular(world, {random.between(-8, 8), random.between(-8, 8)}, 3 + i % 8, random.between(0.3, 1),
                   {.angle = random.between(0, 6), .rounding = i % 2 == 0 ? 0.15 : 0.0});
    }
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
        const Position from = {random.between(-10, 10), random.between(-10, 10)};
        const Position to = {random.between(-10, 10), random.between(-10, 10)};
        const auto hit = world.castRay(from, to);
        const DVec2 way = to - from;
        const double end = hit ? hit->fraction : 1;
        for (const BodyId id : world.bodies()) {
            const Outline outline = outlineInWorld(world, world.body(id).shapes().front());
            const DVec2 a = from - Position{}, b = a + (end - 1e-5) * way;
            if (end > 1e-4) {
                EXPECT_GT(gapBetween(outline, {{a, b}, 0, a, 0}), -1e-5) << "ray " << i;
            }
        }
        if (!hit || hit->fraction == 0) continue;
        ++hits;
        const Outline target = outlineInWorld(world, world.shape(hit->shape));
        const DVec2 p = hit->point - Position{};
        EXPECT_NEAR(gapBetween(target, {{p}, 0, p, 0}), 0, 1e-5) << "ray " << i;
        EXPECT_LT(dot(toDVec2(hit->normal), way), 1e-6 * length(way)) << "ray " << i;
        EXPECT_NEAR(length(hit->normal), 1, 1e-5) << "ray " << i;
    }
    EXPECT_GT(hits, 200);
}

}  // namespace
}  // namespace tamias2d
