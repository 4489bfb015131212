// SPDX-License-Identifier: MIT
// Who meets whom: categories, masks and groups, also when they change under a resting body.
#include "support/build.hpp"
#include "support/run.hpp"
#include "support/traces.hpp"

#include <gtest/gtest.h>

namespace tamias2d {
namespace {

using namespace test;

// Does a disc flying at a wall go through it?
bool passes(const Filter& discFilter, const Filter& wallFilter)
{
    World world(weightless());
    Body wall = addBox(world, {0, 0}, 1, 4, {.type = BodyType::Static});
    Body disc = addDisc(world, {-2, 0}, 0.5, {.velocity = vec(10, 0)});
    wall.shapes().front().setFilter(wallFilter);
    disc.shapes().front().setFilter(discFilter);
    runSeconds(world, 1);
    return disc.position().x > 1;
}

TEST(Filters, BothMasksMustAgree)
{
    TRACES("R7");
    EXPECT_FALSE(passes({}, {}));
    EXPECT_TRUE(passes({.category = 2}, {.mask = ~std::uint64_t{2}}));
    EXPECT_TRUE(passes({.mask = ~std::uint64_t{2}}, {.category = 2}));
    EXPECT_TRUE(passes({.mask = 0}, {}));
    EXPECT_FALSE(passes({.category = 2, .mask = 4}, {.category = 4, .mask = 2}));
    EXPECT_FALSE(passes({.category = std::uint64_t{1} << 63}, {.mask = std::uint64_t{1} << 63}));
    EXPECT_TRUE(passes({.category = 0}, {}));
}

TEST(Filters, ASharedGroupDecidesAlone)
{
    TRACES("R7");
    EXPECT_TRUE(passes({.group = -3}, {.group = -3}));
    EXPECT_FALSE(passes({.mask = 0, .group = 3}, {.mask = 0, .group = 3}));
    EXPECT_FALSE(passes({.group = -3}, {.group = -4})) << "different groups decide nothing";
    EXPECT_FALSE(passes({.group = -3}, {}));
    EXPECT_TRUE(passes({.mask = 0, .group = 3}, {.group = 4}));
}

TEST(Filters, ANewFilterEndsTheContactItForbids)
{
    TRACES("R7");
    World world;
    Body ground = addGround(world);
    Body box = addBox(world, {0, 0.501}, 1, 1);
    runSeconds(world, 0.2);
    ASSERT_TRUE(world.touching(box.id(), ground.id()));
    Shape shape = box.shapes().front();
    shape.setFilter({.mask = 0});
    EXPECT_EQ(shape.filter().mask, 0u);
    world.step();
    EXPECT_FALSE(world.touching(box.id(), ground.id()));
    ASSERT_EQ(world.events().ends.size(), 1u);
    EXPECT_EQ(world.contacts().size(), 0u);
    runSeconds(world, 0.5);
    EXPECT_LT(box.position().y, 0) << "it falls through the ground now";
}

TEST(Filters, ANewFilterAllowsAContactAtOnce)
{
    TRACES("R7");
    World world;
    Body ground = addGround(world);
    Body box = addBox(world, {0, 3}, 1, 1);
    box.shapes().front().setFilter({.mask = 0});
    runSeconds(world, 0.5);
    box.shapes().front().setFilter({});
    runSeconds(world, 1.5);
    EXPECT_TRUE(world.touching(box.id(), ground.id()));
    EXPECT_NEAR(box.position().y, 0.501, 0.003);
}

TEST(Filters, ShapesOfOneBodyNeverMeet)
{
    TRACES("R7");
    World world(weightless());
    Body body = addBox(world, {}, 1, 1);
    body.createShape({.geometry = Circle{}});
    world.step();
    EXPECT_EQ(world.contacts().size(), 0u);
    EXPECT_EQ(body.linearVelocity(), vec(0, 0));
}

TEST(Filters, BodiesThatNothingPushesDoNotMeetEachOther)
{
    TRACES("R7");
    World world;
    addGround(world);
    Body platform = addBox(world, {0, 0}, 1, 1, {.type = BodyType::Kinematic, .velocity = vec(0, -1)});
    addBox(world, {0.2, 0}, 1, 1, {.type = BodyType::Static});
    runSeconds(world, 0.5);
    EXPECT_NEAR(platform.position().y, -0.5, 1e-6);
    for (const ContactView& contact : world.contacts()) {
        for (const ContactPoint& point : contact.points) EXPECT_EQ(point.normalImpulse, real(0));
    }
}

}  // namespace
}  // namespace tamias2d
