// SPDX-License-Identifier: MIT
// A body driven wild by legal input, such as a force of 1e38 N, may be held at the bounds or set aside, and
// the report says so. It must not harm the rest of the world.
#include "support/refusals.hpp"
#include "support/traces.hpp"

#include <functional>

namespace tamias2d {
namespace {

using namespace test;

struct Wild {
    const char* name;
    std::function<void(World&, Body&)> drive;
};

std::vector<Wild> wildThings()
{
    const double most = static_cast<double>(std::numeric_limits<real>::max());
    const auto lawOf = [](DVec2 force, double torque) {
        return ForceLaw{.name = "wild",
                        .force = [=](const BodyView&, double) { return Wrench{force, torque}; }};
    };
    return {
        {"force of 1e30 N", [](World&, Body& b) { b.applyForceToCenter(vec(1e30, 0)); }},
        {"the largest force", [=](World&, Body& b) { b.applyForceToCenter(vec(most, most)); }},
        {"the largest force, twice",
         [=](World&, Body& b) {
             b.applyForceToCenter(vec(most, 0));
             b.applyForceToCenter(vec(most, 0));
         }},
        {"force far off the center", [](World&, Body& b) { b.applyForce(vec(1e30, 0), {0, 1e9}); }},
        {"torque", [](World&, Body& b) { b.applyTorque(toReal(1e29)); }},
        {"the largest torque", [=](World&, Body& b) { b.applyTorque(toReal(most)); }},
        {"lasting force",
         [=](World&, Body& b) { b.addForce({.force = vec(most, 0), .point = vec(0, 1e6)}); }},
        {"gravity", [=](World&, Body& b) { b.setOwnGravity(vec(most, most)); }},
        {"scaled gravity", [=](World&, Body& b) { b.setGravityScale(toReal(most)); }},
        {"law", [=](World&, Body& b) { b.addForceLaw(lawOf({1e300, -1e300}, 0)); }},
        {"turning law", [=](World&, Body& b) { b.addForceLaw(lawOf({}, 1e300)); }},
        {"law that is no number", [=](World&, Body& b) { b.addForceLaw(lawOf({kNaN, 0}, kInfinity)); }},
        {"spring", [](World&, Body& b) { b.addForceLaw(springTo({1e9, 0}, 1e300)); }},
        {"damping", [](World&, Body& b) { b.setLinearDamping(toReal(1e29)); }},
        {"turning damping", [](World&, Body& b) { b.setAngularDamping(toReal(1e29)); }},
        {"damping 1e5", [](World&, Body& b) { b.setLinearDamping(toReal(1e5)); }},
        {"speed", [](World&, Body& b) { b.setLinearVelocity(vec(9.9e5, 0)); }},
        {"spin", [](World&, Body& b) { b.setAngularVelocity(toReal(1e6)); }},
        {"a tiny mass",
         [](World&, Body& b) {
             b.setMass({toReal(1e-37), {}, toReal(1e-37)});
             b.applyForceToCenter(vec(1e3, 0));
         }},
        {"a great mass", [](World&, Body& b) { b.setMass({toReal(1e29), {}, toReal(1e29)}); }},
        {"the edge of the world", [](World&, Body& b) { b.setTransform({1e9, -1e9}, 0); }},
    };
}

std::vector<BodyState> statesOf(const World& world, const std::vector<BodyId>& ids)
{
    std::vector<BodyState> states(ids.size());
    world.readStates(ids, states);
    return states;
}

// The wild body flies alone, 1 km above the others, so that it does not meet them unless it is made to.
TEST(WildBodies, DoNotDisturbTheOthers)
{
    TRACES("R4", "R1");
    const auto build = [](World& world) {
        addGround(world, 0, 20);
        addBox(world, {0, 0.501}, 1, 1, {.velocity = vec(0.5, 0)});
        addDisc(world, {3, 2}, 0.5, {.spin = 1});
        addBox(world, {-5, 1}, 2, 0.2, {.type = BodyType::Kinematic, .velocity = vec(0, 1)});
    };
    World calm;
    build(calm);
    const std::vector<BodyId> ids = calm.bodies();
    for (int i = 0; i < 30; ++i) calm.step();
    const auto expected = statesOf(calm, ids);
    for (const Wild& wild : wildThings()) {
        SCOPED_TRACE(wild.name);
        World world;
        build(world);
        const std::vector<BodyId> others = world.bodies();
        Body body = addBox(world, {0, 1000}, 1, 1);
        wild.drive(world, body);
        for (int i = 0; i < 30; ++i) {
            EXPECT_EQ(world.step().status, StepStatus::Done);
            EXPECT_TRUE(isFinite(body.position()) && isFinite(body.linearVelocity()) &&
                        std::isfinite(body.angularVelocity()) && std::isfinite(body.angle()));
            EXPECT_LE(length(toDVec2(body.linearVelocity())), 1.00001e6);
            EXPECT_LE(std::abs(body.angularVelocity()), toReal(1.00001e6));
        }
        const auto states = statesOf(world, others);
        for (std::size_t i = 0; i < others.size(); ++i) {
            EXPECT_TRUE(world.body(others[i]).isEnabled()) << "body " << i;
            EXPECT_EQ(states[i].position, expected[i].position) << "body " << i;
            EXPECT_EQ(states[i].angle, expected[i].angle) << "body " << i;
            EXPECT_EQ(states[i].linearVelocity, expected[i].linearVelocity) << "body " << i;
        }
    }
}

// It lies among the others: they may be pushed, yet stay in the world, and what nothing pushes stays put.
TEST(WildBodies, LeaveTheirNeighborsInTheWorld)
{
    TRACES("R4");
    for (const Wild& wild : wildThings()) {
        SCOPED_TRACE(wild.name);
        World world;
        Body ground = addGround(world, 0, 20);
        Body body = addBox(world, {0, 0.501}, 1, 1);
        Body onTop = addBox(world, {0, 1.502}, 1, 1);
        Body beside = addDisc(world, {1.001, 0.501}, 0.5);
        world.step();
        wild.drive(world, body);
        for (int i = 0; i < 10; ++i) world.step();
        for (const Body& other : {ground, onTop, beside}) {
            EXPECT_TRUE(other.isEnabled());
            EXPECT_TRUE(isFinite(other.position()) && isFinite(other.linearVelocity()) &&
                        std::isfinite(other.angularVelocity()));
        }
        EXPECT_EQ(ground.position(), (Position{0, -0.5}));
    }
}

TEST(WildBodies, CannotBeMadeByAnImpulse)
{
    TRACES("R4", "DC-v", "DC-omega");
    Everything all;
    for (const double j : {1.1e6, -1.1e6, 1e30}) {
        expectRefused(all, "applyImpulse", "impulse", [&] { all.box.applyImpulse(vec(j, 0), {0, 0.5}); });
        expectRefused(all, "applyImpulseToCenter", "impulse",
                      [&] { all.box.applyImpulseToCenter(vec(0, j)); });
        expectRefused(all, "applyAngularImpulse", "impulse", [&] { all.box.applyAngularImpulse(toReal(j)); });
    }
    all.box.applyImpulseToCenter(vec(9e5, 0));
    EXPECT_NEAR(all.box.linearVelocity().x, 9e5, 2);
}

// A body on which a strong damping acts stops; before, exp(c h / 2) overflowed and the body was set aside.
TEST(WildBodies, AreNotMadeByStrongDamping)
{
    TRACES("LC2", "R5");
    for (const double c : {1e3, 1e4, 1e5, 1e6, 1e12}) {
        World world(withGravity(0, -10));
        Body body = addBox(world, {0, 0}, 1, 1, {.velocity = vec(1, 0), .spin = 1});
        body.setLinearDamping(toReal(c));
        body.setAngularDamping(toReal(c));
        world.step();
        EXPECT_EQ(world.lastReport().nonFinite, 0u) << c;
        EXPECT_NEAR(body.position().x, 1 / c, 0.01 / c) << c;
        EXPECT_NEAR(body.linearVelocity().x, 0, 1e-6) << c;
        EXPECT_NEAR(body.linearVelocity().y, -10 / c, 0.01 * 10 / c) << c;
        EXPECT_NEAR(body.angle(), 1 / c, 0.01 / c) << c;
    }
}

}  // namespace
}  // namespace tamias2d
