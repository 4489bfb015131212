// SPDX-License-Identifier: MIT
// What is kept from step to step of bodies that hardly move: it changes no result, and never outlives what it
// is of.
#include <support/scenes.hpp>

#include <gtest/gtest.h>

namespace tamias2d::test {
namespace {

// A pyramid and a stack at rest, a disc that runs into the stack, one that rolls along, and a shape far away.
Shape build(World& world)
{
    addGround(world, 0, 400);
    addPyramid(world, 12);
    addStack(world, 6, 20);
    addDisc(world, {60, 0.501}, 0.5, {.velocity = vec(-4, 0), .spin = 8});
    addDisc(world, {-60, 0.501}, 0.5, {.velocity = vec(0.3, 0), .spin = -0.6, .restitution = 0.5});
    return addBox(world, {0, 300}, 1, 1, {.type = BodyType::Static}).shapes().front();
}

// Nothing sleeps.
WorldDef restless(Vec2 gravity = vec(0, -9.81))
{
    WorldDef def;
    def.gravity = gravity;
    def.allowSleep = false;
    return def;
}

}  // namespace

// Another material of a shape that nothing touches makes the world match its pairs, color its contacts and
// fill its lanes anew.
TEST(Kept, PairsColorsAndLanesGiveTheBitsOfMakingThemAnew)
{
    TRACES("NFR1", "ADR6", "ADR27");
    World keeps(restless()), renews(restless());
    build(keeps);
    Shape far = build(renews);
    const Material before = far.material();
    Material other = before;
    other.friction = toReal(0.1);
    for (int i = 0; i < 600; ++i) {
        far.setMaterial(i % 2 == 0 ? other : before);
        keeps.step();
        renews.step();
        if (i % 50 != 0) continue;
        EXPECT_EQ(keeps.validate(), std::vector<std::string>{}) << "step " << i;
    }
    far.setMaterial(before);
    EXPECT_EQ(keeps.stateHash(), renews.stateHash());
}

TEST(Kept, PilesStandAsTheyDoWhenAllIsFoundAnew)
{
    TRACES("T2", "NFR1", "ADR27");
    World world(restless());
    addGround(world);
    const std::vector<Placed> boxes = addPyramid(world, 15);
    for (int i = 0; i < 1800; ++i) world.step();
    double sunk = 0;
    for (const Placed& box : boxes) sunk = std::max(sunk, std::abs(box.sunk()));
    record("sunk", sunk);
    EXPECT_LE(sunk, 2e-3);
    EXPECT_LE(furthestSideways(boxes), 1e-3);
}

// Each of these concerns a pile that has been at rest for a while.
TEST(Kept, NothingOutlivesWhatItIsOf)
{
    TRACES("R3", "R7", "ADR27");
    struct Case {
        const char* what;
        void (*act)(World&, Body ground, Body box);
        bool slides, falls;
    };
    const Case cases[] = {
        {"nothing", [](World&, Body, Body) {}, false, false},
        {"a smooth ground",
         [](World&, Body ground, Body box) {
             for (const Body& body : {ground, box}) {
                 Material smooth = body.shapes().front().material();
                 smooth.friction = 0;
                 body.shapes().front().setMaterial(smooth);
             }
         },
         true, false},
        {"another filter",
         [](World&, Body ground, Body) {
             Filter none = ground.shapes().front().filter();
             none.mask = 0;
             ground.shapes().front().setFilter(none);
         },
         false, true},
        {"a ground that is gone", [](World&, Body ground, Body) { ground.destroy(); }, false, true},
        {"a ground that is disabled", [](World&, Body ground, Body) { ground.setEnabled(false); }, false,
         true},
        {"a ground that moved away", [](World&, Body ground, Body) { ground.setTransform({0, -3}, 0); },
         false, true},
        {"a smaller ground",
         [](World&, Body ground, Body) {
             ShapeDef def = ground.shapes().front().definition();
             def.geometry = makeBox(1, toReal(0.5));
             ground.shapes().front().redefine(def);
         },
         false, true},
        {"a joint that lets them through",
         [](World& world, Body ground, Body box) {
             JointDef def;
             def.bodyA = ground.id();
             def.bodyB = box.id();
             def.kind = FilterJoint{};
             world.createJoint(def);
         },
         false, true},
    };
    for (const Case& each : cases) {
        World world(restless(vec(1, -10)));
        Body ground = addGround(world, 0, 40, {.friction = 0.9});
        Body box = addBox(world, {0, 0.501}, 1, 1, {.friction = 0.9});
        for (int i = 0; i < 120; ++i) world.step();
        const Position before = box.position();
        each.act(world, ground, box);
        for (int i = 0; i < 30; ++i) world.step();
        const double along = box.position().x - before.x, down = before.y - box.position().y;
        if (!each.falls) {
            EXPECT_EQ(along > 0.1, each.slides) << each.what << ": went " << along << " m along";
        }
        EXPECT_EQ(down > 0.2, each.falls) << each.what << ": fell " << down << " m";
        EXPECT_EQ(world.validate(), std::vector<std::string>{}) << each.what;
    }
}

// Set down again and again by less than what would be noticed at once, it has gone a long way in the end.
TEST(Kept, SmallMovesAddUp)
{
    TRACES("R7", "ADR27");
    World world(restless());
    Body ground = addGround(world, 0, 4);
    Body box = addBox(world, {0, 0.501}, 1, 1);
    for (int i = 0; i < 60; ++i) world.step();
    for (int i = 0; i < 1500; ++i) {
        ground.setTransform({ground.position().x, ground.position().y - 1e-4}, 0);
        world.step();
    }
    EXPECT_NEAR(box.position().y, 0.501 - 0.15, 2e-3) << "it follows the ground";
    ground.setTransform({10, ground.position().y}, 0);
    for (int i = 0; i < 60; ++i) world.step();
    EXPECT_LE(box.position().y, -3);
}

}  // namespace tamias2d::test
