// SPDX-License-Identifier: MIT
// What is written reads back the same, to the bit.
#include "support/build.hpp"
#include "support/own_joints.hpp"
#include "support/traces.hpp"

#include <tamias2d/scene/builtin.hpp>
#include <tamias2d/scene/read.hpp>
#include <tamias2d/scene/write.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tamias2d::test {
namespace {

/// A world in which nothing has its default value.
std::unique_ptr<World> strangeWorld()
{
    WorldDef def;
    def.gravity = vec(0.1, -1.625);
    def.gravitationConstant = toReal(6.673e-11);
    def.lengthUnit = 2;
    def.frictionMixing = MixingRule::Average;
    def.restitutionMixing = MixingRule::Minimum;
    def.tuning.restGap = toReal(0.002);
    def.tuning.crowd = 20;
    def.tuning.impactsPerContact = 70;
    def.tuning.sleepTime = toReal(0.7);
    def.tuning.sleepSpeed = toReal(0.003);
    def.allowSleep = false;
    auto world = std::make_unique<World>(def);

    BodyDef body;
    body.type = BodyType::Dynamic;
    body.position = {1.0 / 3, -123456.789012345678};
    body.angle = 1e-300;
    body.linearVelocity = vec(1.0 / 3, -0.0);
    body.angularVelocity = toReal(-0.1);
    body.mass = MassProperties{toReal(0.3), vec(0.01, -0.02), toReal(0.7)};
    body.linearDamping = toReal(0.05);
    body.angularDamping = toReal(0.07);
    body.gravityScale = toReal(-0.9);
    body.gravity = vec(3.3, 4.4);
    body.lockX = true;
    body.lockRotation = true;
    body.enabled = false;
    body.allowSleep = false;
    body.name = "a \"quoted\" </name>, with \xc3\xa4";
    body.userData = std::numeric_limits<std::uint64_t>::max();
    Body first = world->createBody(body);

    ShapeDef shape;
    shape.offset = vec(0.3, 0.1);
    shape.angle = 0.7;
    shape.density = toReal(2.1);
    shape.material = {toReal(0.1), toReal(0.35), toReal(0.02), -3, MixingRule::Multiply, MixingRule::Maximum};
    shape.filter = {0x8000000000000001u, 0x00ff00ff00ff00ffu, -7};
    shape.userData = 12345678901234567890u;
    for (const Geometry& geometry :
         {Geometry(Circle{vec(0.1, 0.2), toReal(0.3)}),
          Geometry(Capsule{vec(0, 0), vec(0.1, 1), toReal(0.2)}),
          Geometry(Segment{vec(-1, 0), vec(1, 0.1), toReal(0.01)}),
          Geometry(makeBox(toReal(0.6), toReal(1.1))), Geometry(makeBox(1, 2, toReal(0.1))),
          Geometry(makeRegularPolygon(7, toReal(0.9), toReal(0.05)))}) {
        shape.geometry = geometry;
        first.createShape(shape);
    }
    first.addForce({vec(1, 2), vec(0.1, 0), true, false, toReal(0.3)});
    first.addForce({vec(0, -1), vec(0, 0), false, true, 0});

    body = {};
    body.type = BodyType::Kinematic;
    body.lockY = true;
    world->createBody(body).createShape({});
    world->createBody();

    JointDef joint;
    joint.bodyA = world->bodies()[1];
    joint.bodyB = first.id();
    const JointLimits limits{toReal(-0.3), toReal(1.7)};
    const JointMotor motor{toReal(0.1), toReal(22.5)};
    const JointSpring spring{toReal(3.3), toReal(0.1), toReal(0.7)};
    const JointSpring spring0{toReal(1.5), toReal(0.2), 0};
    joint.kind = RevoluteJoint{vec(0.1, 0.2), vec(-0.3, 0.4), 1.0 / 3, limits, motor, spring, -3};
    joint.collideConnected = true;
    joint.enabled = false;
    joint.breaking = {100, toReal(0.1), 3, toReal(0.3)};
    joint.name = "hinge";
    joint.userData = 18446744073709551615u;
    world->createJoint(joint);
    for (const JointKind& kind :
         {JointKind(DistanceJoint{vec(0, 1), vec(2, 3), toReal(0.4), JointLimits{toReal(0.1), kUnlimited},
                                  motor, spring}),
          JointKind(DistanceJoint{}),
          JointKind(PrismaticJoint{vec(1, 1), vec(2, 2), vec(0.6, 0.8), -0.1, limits, motor, spring}),
          JointKind(WeldJoint{vec(1, 0), vec(0, 1), 0.1, JointSpring{2, toReal(0.3), 0}, JointSpring{}}),
          JointKind(TargetJoint{vec(0.1, 0), {1.0 / 3, 2}, 0.7, toReal(3.5), toReal(0.9), 100, 50}),
          JointKind(TargetJoint{}),
          JointKind(WheelJoint{vec(1, 2), vec(3, 4), vec(0.6, -0.8), limits, motor, std::nullopt}),
          JointKind(WheelJoint{{}, {}, vec(0, 2), {}, {}, spring}),
          JointKind(GrooveJoint{vec(0.1, 0.2), vec(3, 0.1), vec(-1, 1)}),
          JointKind(RotaryJoint{1.0 / 3, limits, motor, spring, 2}),
          JointKind(RatchetJoint{-0.1, toReal(-0.3)}), JointKind(GearJoint{toReal(-2.3), 1.0 / 3}),
          JointKind(RackJoint{vec(1, 2), vec(3, 4), vec(0.6, 0.8), toReal(-0.7), 1.0 / 3}),
          JointKind(PulleyJoint{vec(0.1, 0),
                                vec(0, 0.2),
                                {-1.1, 5},
                                {1.0 / 3, 6},
                                toReal(2.5),
                                toReal(7.7),
                                true,
                                toReal(0.1),
                                toReal(0.2)}),
          JointKind(MotorJoint{vec(1, 0), vec(0, 1), 0.1, spring0, JointSpring{}, vec(0.1, 0.2), toReal(0.3),
                               9, toReal(8.1)}),
          JointKind(FrictionJoint{vec(0.1, 0.2), toReal(3.3), toReal(4.4)}), JointKind(FilterJoint{})}) {
        joint = {};
        joint.bodyA = first.id();
        joint.bodyB = world->bodies()[2];
        joint.kind = kind;
        world->createJoint(joint);
    }

    world->addForceLaw(drag(0.1, 0.2));
    world->body(world->bodies()[2]).addForceLaw(springTo({1, 2}, 30, 0.5));
    world->addForceLaw(attractionTo({-1, 0.1}, 5, 0.01));
    first.addForceLaw(torsionSpring(0.1, 2));
    return world;
}

void expectSameShape(const ShapeDef& a, const ShapeDef& b)
{
    EXPECT_EQ(a.offset, b.offset);
    EXPECT_EQ(a.angle, b.angle);
    EXPECT_EQ(a.density, b.density);
    EXPECT_EQ(a.material, b.material);
    EXPECT_EQ(a.filter, b.filter);
    EXPECT_EQ(a.userData, b.userData);
    ASSERT_EQ(a.geometry.index(), b.geometry.index());
    if (const auto* circle = std::get_if<Circle>(&a.geometry)) {
        EXPECT_EQ(circle->center, std::get<Circle>(b.geometry).center);
        EXPECT_EQ(circle->radius, std::get<Circle>(b.geometry).radius);
    }
    if (const auto* polygon = std::get_if<Polygon>(&a.geometry)) {
        const Polygon& other = std::get<Polygon>(b.geometry);
        ASSERT_EQ(polygon->count, other.count);
        EXPECT_EQ(polygon->vertices, other.vertices);
        EXPECT_EQ(polygon->radius, other.radius);
    }
}

void expectSameBody(const Body& a, const Body& b)
{
    const BodyDef x = a.definition(), y = b.definition();
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.type, y.type);
    EXPECT_EQ(x.position, y.position);
    EXPECT_EQ(x.angle, y.angle);
    EXPECT_EQ(x.linearVelocity, y.linearVelocity);
    EXPECT_EQ(std::signbit(x.linearVelocity.y), std::signbit(y.linearVelocity.y));
    EXPECT_EQ(x.angularVelocity, y.angularVelocity);
    EXPECT_EQ(x.gravity, y.gravity);
    EXPECT_EQ(x.enabled, y.enabled);
    EXPECT_EQ(x.userData, y.userData);
    EXPECT_EQ(x.lockX, y.lockX);
    EXPECT_EQ(x.lockY, y.lockY);
    EXPECT_EQ(x.lockRotation, y.lockRotation);
    EXPECT_EQ(a.mass(), b.mass());
    EXPECT_EQ(a.inertia(), b.inertia());
    EXPECT_EQ(a.localCenter(), b.localCenter());
    ASSERT_EQ(a.lastingForces().size(), b.lastingForces().size());
    const auto shapesA = a.shapes(), shapesB = b.shapes();
    ASSERT_EQ(shapesA.size(), shapesB.size());
    for (std::size_t i = 0; i < shapesA.size(); ++i) {
        expectSameShape(shapesA[i].definition(), shapesB[i].definition());
    }
}

TEST(SceneRoundTrip, EverythingAWorldHoldsComesBack)
{
    TRACES("R2", "R3", "ADR14");
    const auto world = strangeWorld();
    SceneInfo info;
    info.title = "Strange";
    info.description = "Nothing has its default value.";
    info.seconds = 1.5;
    info.rate = 240;
    info.substeps = 2;
    info.view = Aabb{{-1, -2}, {3, 4.5}};
    const std::string text = writeScene(*world, info);
    const Scene scene = readScene(text, "written");

    EXPECT_EQ(scene.info.title, info.title);
    EXPECT_EQ(scene.info.description, info.description);
    EXPECT_EQ(scene.info.seconds, info.seconds);
    EXPECT_EQ(scene.info.rate, info.rate);
    EXPECT_EQ(scene.info.substeps, info.substeps);
    ASSERT_TRUE(scene.info.view);
    EXPECT_EQ(scene.info.view->upper, info.view->upper);

    const WorldDef &a = world->definition(), &b = scene.world->definition();
    EXPECT_EQ(a.gravity, b.gravity);
    EXPECT_EQ(a.gravitationConstant, b.gravitationConstant);
    EXPECT_EQ(a.lengthUnit, b.lengthUnit);
    EXPECT_EQ(a.frictionMixing, b.frictionMixing);
    EXPECT_EQ(a.restitutionMixing, b.restitutionMixing);
    EXPECT_EQ(a.tuning, b.tuning);

    const auto idsA = world->bodies(), idsB = scene.world->bodies();
    ASSERT_EQ(idsA.size(), idsB.size());
    for (std::size_t i = 0; i < idsA.size(); ++i) {
        expectSameBody(world->body(idsA[i]), scene.world->body(idsB[i]));
    }
    const auto jointsA = world->joints(), jointsB = scene.world->joints();
    ASSERT_EQ(jointsA.size(), jointsB.size());
    for (std::size_t i = 0; i < jointsA.size(); ++i) {
        const JointDef x = world->joint(jointsA[i]).definition();
        const JointDef y = scene.world->joint(jointsB[i]).definition();
        EXPECT_EQ(x.kind, y.kind) << "joint " << i;
        EXPECT_EQ(x.bodyA.index, y.bodyA.index);
        EXPECT_EQ(x.bodyB.index, y.bodyB.index);
        EXPECT_EQ(x.collideConnected, y.collideConnected);
        EXPECT_EQ(x.enabled, y.enabled);
        EXPECT_EQ(x.breaking, y.breaking);
        EXPECT_EQ(x.name, y.name);
        EXPECT_EQ(x.userData, y.userData);
    }
    const auto lawsA = world->forceLaws(), lawsB = scene.world->forceLaws();
    ASSERT_EQ(lawsA.size(), lawsB.size());
    for (std::size_t i = 0; i < lawsA.size(); ++i) {
        EXPECT_EQ(lawsA[i].first.index, lawsB[i].first.index);
        EXPECT_EQ(lawsA[i].second.name, lawsB[i].second.name);
        EXPECT_EQ(lawsA[i].second.parameters, lawsB[i].second.parameters);
    }
    EXPECT_EQ(writeScene(*scene.world, scene.info), text);
}

TEST(SceneRoundTrip, WritingEverythingReadsTheSame)
{
    TRACES("R2");
    const auto world = strangeWorld();
    const std::string text = writeScene(*world, {}, {.everything = true});
    const Scene scene = readScene(text);
    EXPECT_EQ(writeScene(*scene.world, scene.info, {.everything = true}), text);
}

TEST(SceneRoundTrip, AMovingWorldIsCaughtToTheBit)
{
    TRACES("R5", "R6", "ADR6");
    for (const char* name : {"pile:count=30,shapes=mixed", "gas:discs=10,boxes=10", "dominoes"}) {
        const Scene first = makeBuiltinScene(name);
        for (int i = 0; i < 90; ++i) first.world->step();
        const Scene again = readScene(writeScene(*first.world));
        const auto ids = first.world->bodies(), idsAgain = again.world->bodies();
        ASSERT_EQ(ids.size(), idsAgain.size()) << name;
        std::vector<BodyState> a(ids.size()), b(ids.size());
        first.world->readStates(ids, a);
        again.world->readStates(idsAgain, b);
        for (std::size_t i = 0; i < ids.size(); ++i) {
            EXPECT_EQ(a[i].position, b[i].position) << name << " body " << i;
            EXPECT_EQ(a[i].angle, b[i].angle) << name << " body " << i;
            EXPECT_EQ(a[i].linearVelocity, b[i].linearVelocity) << name << " body " << i;
            EXPECT_EQ(a[i].angularVelocity, b[i].angularVelocity) << name << " body " << i;
        }
    }
}

TEST(SceneRoundTrip, AWorldFromTextMovesLikeTheWorldFromCode)
{
    TRACES("R1", "ADR6");
    const Scene code = makeBuiltinScene("pile:count=20");
    const Scene text = readScene(writeScene(*code.world));
    EXPECT_EQ(code.world->stateHash(), text.world->stateHash());
    for (int i = 0; i < 120; ++i) {
        code.world->step();
        text.world->step();
    }
    EXPECT_EQ(code.world->stateHash(), text.world->stateHash());
}

TEST(SceneRoundTrip, ALawOfOnesOwnIsWrittenByNameAndTakenFromTheReadersList)
{
    TRACES("R2");
    ForceLaw wind;
    wind.name = "wind";
    wind.force = [](const BodyView& body, double) { return Wrench{{body.mass, 0}, 0}; };
    World world(weightless());
    addDisc(world, {0, 0}, 0.5);
    world.addForceLaw(wind);

    const std::string text = writeScene(world);
    EXPECT_NE(text.find("{\"law\": \"wind\"}"), std::string::npos) << text;
    EXPECT_THROW(readScene(text), SceneError);

    const Scene scene = readScene(text, "scene", {.laws = {wind}});
    ASSERT_EQ(scene.world->forceLaws().size(), 1u);
    for (int i = 0; i < 60; ++i) scene.world->step();
    // 1 m/s^2 for 1 s
    const Body disc = scene.world->body(scene.world->bodies()[0]);
    EXPECT_NEAR(static_cast<double>(disc.linearVelocity().x), 1, 1e-5);
}

// Nothing bears a load here, so that there is nothing to carry on that a file does not have.
TEST(SceneRoundTrip, WhatHasTurnedSeveralTimesGoesOnWithTheSameBits)
{
    TRACES("LC3", "R2");
    for (const double speed : {7.0, -7.0}) {
        World world(weightless());
        Body post = addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static});
        Body wheel = addDisc(world, {0, 0}, 0.5, {.spin = speed});
        Body dial = addDisc(world, {3, 0}, 0.5, {.spin = 0.9 * speed});
        const JointLimits limits{toReal(-26), toReal(26)};
        world.createJoint(jointOf(post, wheel, RevoluteJoint{.referenceAngle = 0.5, .limits = limits}));
        world.createJoint(jointOf(post, dial, RotaryJoint{.referenceAngle = -1, .limits = limits}));
        for (int step = 0; step < 180; ++step) world.step();

        const std::string text = writeScene(world);
        const Scene scene = readScene(text);
        EXPECT_EQ(writeScene(*scene.world, scene.info), text);
        for (int step = 0; step < 120; ++step) {  // into its limit, and back
            world.step();
            scene.world->step();
        }
        for (std::size_t i = 0; i < world.joints().size(); ++i) {
            const JointReading a = world.joint(world.joints()[i]).reading();
            const JointReading b = scene.world->joint(scene.world->joints()[i]).reading();
            EXPECT_EQ(a.position, b.position) << "joint " << i;
            EXPECT_EQ(a.speed, b.speed) << "joint " << i;
            EXPECT_GT(std::abs(a.position), 18) << "joint " << i;
            EXPECT_LT(std::abs(a.position), 26.001) << "joint " << i;
        }
    }
}

// A gear that has turned 3 times: the wheels neither jump nor get out of step.
TEST(SceneRoundTrip, AGearThatHasTurnedSeveralTimesGoesOnAtTheSameTurn)
{
    TRACES("LC3", "R2");
    World world(weightless());
    Body post = addDisc(world, {0, 0}, 0.05, {.type = BodyType::Static});
    Body driver = addDisc(world, {0, 0}, 0.5), driven = addDisc(world, {3, 0}, 0.5);
    RevoluteJoint axle;
    axle.motor = JointMotor{toReal(7), 100};
    world.createJoint(jointOf(post, driver, axle));
    world.createJoint(revoluteAt(post, driven, {3, 0}));
    world.createJoint(gearBetween(driver, driven, toReal(-0.7)));
    for (int step = 0; step < 180; ++step) world.step();
    const Scene scene = readScene(writeScene(world));
    for (int step = 0; step < 180; ++step) {
        world.step();
        scene.world->step();
    }
    for (int i = 0; i < 3; ++i) {
        const JointReading a = world.joint(world.joints()[static_cast<std::size_t>(i)]).reading();
        const JointReading b =
            scene.world->joint(scene.world->joints()[static_cast<std::size_t>(i)]).reading();
        // Of a gear's B turns are counted anew, its own phase with them.
        EXPECT_NEAR(std::remainder(a.position - b.position, 2 * kPi), 0, 1e-4) << "joint " << i;
        EXPECT_NEAR(static_cast<double>(b.angularError), 0, 1e-4) << "joint " << i;
    }
}

TEST(SceneRoundTrip, AJointOfOnesOwnIsRefusedByItsName)
{
    TRACES("R4", "LC3", "ADR14");
    World world(weightless());
    Body a = addDisc(world, {0, 0}, 0.5), b = addDisc(world, {2, 0}, 0.5), c = addDisc(world, {4, 0}, 0.5);
    world.createJoint(revoluteAt(a, b, {1, 0}));
    Joint own = world.createJoint(Differential{}, a, b, c);
    const std::uint64_t before = world.stateHash();
    try {
        writeScene(world);
        ADD_FAILURE() << "was written";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "joints[1] = Differential: must be of a built-in kind: a file holds no code");
    }
    EXPECT_EQ(world.stateHash(), before);
    own.destroy();
    EXPECT_EQ(readScene(writeScene(world)).world->jointCount(), 1u);
}

TEST(SceneRoundTrip, PolygonsMayBeGivenInAnyOrder)
{
    TRACES("R2");
    const Scene scene = readScene(R"({"tamias2d": 1, "bodies": [
        {"shapes": [{"polygon": {"vertices": [[0, 0], [1, 1], [1, 0], [0, 1], [0.5, 0.5]]}}]}]})");
    const Body body = scene.world->body(scene.world->bodies()[0]);
    EXPECT_EQ(std::get<Polygon>(body.shapes()[0].definition().geometry).count, 4);
    EXPECT_NEAR(static_cast<double>(body.mass()), 1, 1e-6);
}

}  // namespace
}  // namespace tamias2d::test
