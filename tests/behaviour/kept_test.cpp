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

// Manifolds stay with what moves along together: a pyramid that a lift takes 120 m away, until the lift turns
// back at once, is to stand on it as on a ground, and its center is to fall freely when the lift falls away.
TEST(Kept, APyramidOnALiftStandsAsOnAGround)
{
    TRACES("T2", "R3", "ADR27");
    World world(restless());
    const Vec2 way = vec(1, 4);
    Body lift = addBox(world, {0, -0.5}, 30, 1, {.type = BodyType::Kinematic, .velocity = way});
    const std::vector<Placed> boxes = addPyramid(world, 8);
    for (Placed box : boxes) box.body.setLinearVelocity(way);
    const auto off = [&](double x, double y) {
        double most = 0;
        for (const Placed& box : boxes) {
            const Position at = box.body.centerOfMass();
            most = std::max({most, std::abs(at.x - box.start.x - x), std::abs(at.y - box.start.y - y)});
        }
        return most;
    };
    for (int i = 0; i < 1800; ++i) world.step();
    const Position there = lift.position();
    record("off while it goes", off(there.x, there.y + 0.5));
    EXPECT_LE(off(there.x, there.y + 0.5), 2e-3);

    lift.setLinearVelocity(vec(0, -60));
    const auto height = [&] {
        double sum = 0;
        for (const Placed& box : boxes) sum += box.body.centerOfMass().y;
        return sum / static_cast<double>(boxes.size());
    };
    const double before = height();
    for (int i = 0; i < 60; ++i) world.step();
    // In free flight for a second: 4 m/s up, 9.81 m/s^2 down.
    EXPECT_NEAR(height() - before, 4 - 9.81 / 2, 5e-3);
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

// A net of hinges above the ground that a disc flies through, a chain whose load is uneven, a rope, and
// hinges that have all there is about the angle, some of which come down on the ground.
std::vector<Joint> addJointed(World& world)
{
    std::vector<Joint> joints;
    const auto hinge = [&](Body a, Body b, Vec2 onA, Vec2 onB) -> RevoluteJoint {
        RevoluteJoint kind;
        kind.anchorA = onA;
        kind.anchorB = onB;
        JointDef def;
        def.bodyA = a.id();
        def.bodyB = b.id();
        def.kind = kind;
        joints.push_back(world.createJoint(def));
        return kind;
    };
    const Body ground = addGround(world, 0, 400);
    std::vector<Body> net;
    constexpr int kSide = 6;
    for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
            net.push_back(addDisc(world, {1.0 * column, 20 - 1.0 * row}, 0.3));
            if (column > 0) hinge(net[net.size() - 2], net.back(), vec(0.5, 0), vec(-0.5, 0));
            if (row > 0) hinge(net[net.size() - 1 - kSide], net.back(), vec(0, -0.5), vec(0, 0.5));
        }
    }
    hinge(ground, net[0], vec(0, 21), vec(0, 0.5));
    hinge(ground, net[kSide - 1], vec(kSide - 1, 21), vec(0, 0.5));
    addDisc(world, {-6, 16}, 0.5, {.velocity = vec(9, 4), .density = 4});

    Body link = ground;
    for (int i = 0; i < 8; ++i) {
        const Body next = addBox(world, {30.0 + i, 20}, 1, 0.2, {.density = i == 7 ? 80.0 : 1.0});
        hinge(link, next, i == 0 ? vec(29.5, 20.5) : vec(0.5, 0), vec(-0.5, 0));
        link = next;
    }
    for (int i = 0; i < 4; ++i) {
        const double x = -30 - 5 * i, y = i < 2 ? 30 : 1.5;
        Body middle = addBox(world, {x, y}, 1, 0.3);
        for (const double side : {-1.0, 1.0}) {
            const Body arm = addBox(world, {x + side, y}, 1, 0.3);
            RevoluteJoint kind = hinge(middle, arm, vec(0.5 * side, 0), vec(-0.5 * side, 0));
            kind.spring = JointSpring{3, toReal(0.2), toReal(0.3)};
            kind.motor = JointMotor{toReal(side), 4};
            kind.limits = JointLimits{toReal(-0.5), toReal(0.7)};
            joints.back().setKind(kind);
        }
        middle.setAngularVelocity(2);
    }
    return joints;
}

// A joint that is given what it has makes the world list all of them anew; its bodies wake, and so they do in
// the other world.
TEST(Kept, JointsInTheirListsAndLanesGiveTheBitsOfListingThemAnew)
{
    TRACES("NFR1", "ADR6", "ADR27", "ADR30");
    for (const int every : {1, 7}) {
        World keeps(restless()), renews(restless());
        const std::vector<Joint> kept = addJointed(keeps);
        std::vector<Joint> joints = addJointed(renews);
        for (int i = 0; i < 400; ++i) {
            const std::size_t at = static_cast<std::size_t>(i) % joints.size();
            if (i % every == 0) {
                joints[at].setKind(joints[at].kind());
                keeps.body(kept[at].bodyA()).wake();
                keeps.body(kept[at].bodyB()).wake();
            }
            keeps.step();
            renews.step();
            if (i % 50 != 0) continue;
            ASSERT_EQ(keeps.stateHash(), renews.stateHash()) << "step " << i << ", anew every " << every;
            EXPECT_EQ(keeps.validate(), std::vector<std::string>{}) << "step " << i;
        }
        EXPECT_EQ(keeps.stateHash(), renews.stateHash()) << "anew every " << every;
    }
}

// What hangs by a hinge knows what becomes of it, of its bodies and of their masses.
TEST(Kept, HingesFollowWhatChangesAboutThem)
{
    TRACES("R3", "R7", "ADR27", "ADR30");
    struct Case {
        const char* what;
        void (*act)(World&, Body arm, Joint joint);
        double turns, falls;  // more than [rad], [m]
    };
    const Case cases[] = {
        {"nothing", [](World&, Body, Joint) {}, 0, 0},
        {"a joint that is disabled", [](World&, Body, Joint joint) { joint.setEnabled(false); }, 0, 1},
        {"a joint that is gone", [](World& world, Body, Joint joint) { world.destroyJoint(joint.id()); }, 0,
         1},
        {"a motor",
         [](World&, Body, Joint joint) {
             RevoluteJoint kind = std::get<RevoluteJoint>(joint.kind());
             kind.motor = JointMotor{1, 1000};
             joint.setKind(kind);
         },
         0.2, 0},
        {"a center of mass beside the anchors",
         [](World&, Body arm, Joint) {
             arm.setMass({.mass = arm.mass(), .center = vec(0.5, 0), .inertia = arm.inertia()});
         },
         0.2, 0},
    };
    for (const Case& each : cases) {
        World world(restless());
        const Body ground = addGround(world, -20, 40);
        std::vector<Body> arms;
        std::vector<Joint> joints;
        for (int i = 0; i < 12; ++i) {
            arms.push_back(addBox(world, {0, -0.5 - i}, 0.2, 1));
            JointDef def;
            def.bodyA = i == 0 ? ground.id() : arms[arms.size() - 2].id();
            def.bodyB = arms.back().id();
            RevoluteJoint kind;
            kind.anchorA = i == 0 ? vec(0, 20.5) : vec(0, -0.5);
            kind.anchorB = vec(0, 0.5);
            def.kind = kind;
            joints.push_back(world.createJoint(def));
        }
        for (int i = 0; i < 60; ++i) world.step();
        const double angle = arms.back().angle(), height = arms.back().position().y;
        each.act(world, arms.back(), joints.back());
        for (int i = 0; i < 30; ++i) world.step();
        const double turned = std::abs(std::remainder(arms.back().angle() - angle, 2 * kPi));
        EXPECT_EQ(turned > 0.2, each.turns > 0) << each.what << ": turned " << turned << " rad";
        EXPECT_EQ(height - arms.back().position().y > 1, each.falls > 0) << each.what;
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

// What a step leaves in lanes is told to the table when somebody asks, in the midst of a hail that meets in
// mid-step what nothing was expected to reach.
TEST(Kept, StepsGoOnAlikeWhetherOrNotAnybodyAsks)
{
    TRACES("NFR1", "ADR6", "ADR27");
    World asked, silent;
    std::uint32_t repaired = 0;
    for (World* world : {&asked, &silent}) {
        addGround(*world, 0, 400);
        addPyramid(*world, 10);
        addStack(*world, 6, 20);
        for (int i = 0; i < 12; ++i)
            addBox(*world, {-40.0 - 3 * i, 2.0 + 0.3 * i}, 0.4, 0.4,
                   {.velocity = vec(40 + 3 * i, 2), .spin = toReal(5 - i), .restitution = 0.4});
        for (int i = 0; i < 6; ++i)
            addDisc(*world, {20.2, 12.0 + 2 * i}, 0.4, {.velocity = vec(0, -20), .restitution = 0.8});
    }
    for (int i = 0; i < 300; ++i) {
        repaired += asked.step().repaired;
        silent.step();
        EXPECT_EQ(asked.validate(), std::vector<std::string>{}) << "step " << i;
        for (const ContactView& c : asked.contacts())
            EXPECT_TRUE(std::isfinite(c.impulse.x) && c.pointCount <= 2) << "step " << i;
        asked.stateHash();
    }
    EXPECT_EQ(asked.stateHash(), silent.stateHash());
    EXPECT_GT(repaired, 0u) << "steps in which others came in";
}

// Who flies through a room that has been found clear does not look what rests there: until something does.
TEST(Kept, ClearRoomsEndWhereSomethingComesToRest)
{
    TRACES("T2", "NFR1", "ADR27");
    const auto flight = [](World& world) {
        addGround(world, 0, 2000);
        return addDisc(world, {-100, 50}, 0.5, {.velocity = vec(20, 0), .restitution = 1});
    };
    const auto fly = [](World& world, Body disc) {
        for (int i = 0; i < 40; ++i) world.step();
        EXPECT_NEAR(disc.linearVelocity().x, 20, 1e-4);
    };
    const auto expectReturn = [](World& world, Body disc, const char* how) {
        for (int i = 0; i < 15; ++i) world.step();
        EXPECT_LT(disc.linearVelocity().x, -5) << how;
        EXPECT_EQ(world.validate(), std::vector<std::string>{}) << how;
    };
    {
        World world(restless(vec(0, 0)));
        Body disc = flight(world);
        fly(world, disc);
        addBox(world, {disc.position().x + 2, 50}, 1, 20, {.type = BodyType::Static, .restitution = 1});
        expectReturn(world, disc, "a wall is built");
    }
    {
        World world(restless(vec(0, 0)));
        Body disc = flight(world);
        Body wall = addBox(world, {0, 500}, 1, 20, {.type = BodyType::Static, .restitution = 1});
        fly(world, disc);
        wall.setTransform({disc.position().x + 2, 50}, 0);
        expectReturn(world, disc, "a wall is moved");
    }
    {
        WorldDef def;
        def.gravity = vec(0, 0);
        World world(def);
        Body disc = flight(world);
        Body sleeper = addBox(world, {0, 500}, 1, 1, {.restitution = 1});
        sleeper.setMass({toReal(100), toReal(100), {}});
        fly(world, disc);
        sleeper.setTransform({disc.position().x + 2, 50}, 0);
        sleeper.sleep();
        expectReturn(world, disc, "something goes to sleep there");
    }
    {
        World world(restless(vec(0, 0)));
        Body disc = flight(world);
        fly(world, disc);
        disc.setTransform({-100, 1.2}, 0);
        disc.setLinearVelocity(vec(0, -20));
        for (int i = 0; i < 15; ++i) world.step();
        EXPECT_GT(disc.linearVelocity().y, 5) << "it is somewhere else";
    }
}

}  // namespace tamias2d::test
