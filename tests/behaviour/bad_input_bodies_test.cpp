// SPDX-License-Identifier: MIT
// Every call of Body, and every field of BodyDef, with every kind of wrong value: refused by name, nothing
// changed [R4].
#include "support/refusals.hpp"
#include "support/traces.hpp"

#include <array>

namespace tamias2d {
namespace {

using namespace test;

const std::vector<BadNumber<BodyDef>> kBodyDefFields = {
    {"position", kNoPlace, [](BodyDef& d, double x) { d.position.x = x; }},
    {"position", kNoPlace, [](BodyDef& d, double x) { d.position.y = x; }},
    {"angle", kNotFinite, [](BodyDef& d, double x) { d.angle = x; }},
    {"linearVelocity", kNoSpeed, [](BodyDef& d, double x) { d.linearVelocity.x = toReal(x); }},
    {"linearVelocity", kNoSpeed, [](BodyDef& d, double x) { d.linearVelocity.y = toReal(x); }},
    {"angularVelocity", kNoSpeed, [](BodyDef& d, double x) { d.angularVelocity = toReal(x); }},
    {"mass", kNotPositive, [](BodyDef& d, double x) { d.mass = MassProperties{toReal(x), {}, 1}; }},
    {"inertia", kNegative, [](BodyDef& d, double x) { d.mass = MassProperties{1, {}, toReal(x)}; }},
    {"center", kNotFinite, [](BodyDef& d, double x) { d.mass = MassProperties{1, vec(x, 0), 1}; }},
    {"center", kNotFinite, [](BodyDef& d, double x) { d.mass = MassProperties{1, vec(0, x), 1}; }},
    {"linearDamping", kNegative, [](BodyDef& d, double x) { d.linearDamping = toReal(x); }},
    {"angularDamping", kNegative, [](BodyDef& d, double x) { d.angularDamping = toReal(x); }},
    {"gravityScale", kNotFinite, [](BodyDef& d, double x) { d.gravityScale = toReal(x); }},
    {"gravity", kNotFinite, [](BodyDef& d, double x) { d.gravity = vec(x, 0); }},
    {"gravity", kNotFinite, [](BodyDef& d, double x) { d.gravity = vec(0, x); }},
    {"type", {77}, [](BodyDef& d, double x) { d.type = static_cast<BodyType>(static_cast<int>(x)); }},
};

TEST(BadInput, EveryFieldOfABodyDefinitionIsChecked)
{
    TRACES("R4", "R2", "DC-p", "DC-phi", "DC-v", "DC-omega", "DC-m", "DC-I", "DC-g");
    Everything all;
    for (const auto& entry : kBodyDefFields) {
        for (const double value : entry.values) {
            BodyDef def;
            entry.put(def, value);
            expectRefused(all, "createBody, " + caseName(entry, value), entry.field,
                          [&] { all.world.createBody(def); });
        }
    }
}

TEST(BadInput, TheSpeedOfABodyIsBoundedByItsLength)
{
    TRACES("R4", "DC-v");
    Everything all;
    const Vec2 tooFast = vec(8e5, 8e5);  // 1.13e6 m/s, though each component alone would do
    BodyDef def;
    def.linearVelocity = tooFast;
    expectRefused(all, "createBody", "linearVelocity", [&] { all.world.createBody(def); });
    expectRefused(all, "setLinearVelocity", "velocity", [&] { all.box.setLinearVelocity(tooFast); });
}

const std::vector<BadNumber<Body>> kBodyCalls = {
    {"position", kNoPlace, [](Body& b, double x) { b.setTransform({x, 0}, 0); }},
    {"position", kNoPlace, [](Body& b, double x) { b.setTransform({0, x}, 0); }},
    {"angle", kNotFinite, [](Body& b, double x) { b.setTransform({0, 5}, x); }},
    {"velocity", kNoSpeed, [](Body& b, double x) { b.setLinearVelocity(vec(x, 0)); }},
    {"velocity", kNoSpeed, [](Body& b, double x) { b.setLinearVelocity(vec(0, x)); }},
    {"velocity", kNoSpeed, [](Body& b, double x) { b.setAngularVelocity(toReal(x)); }},
    {"point", kNoPlace, [](Body& b, double x) { b.velocityAt({x, 0}); }},
    {"alpha", notFiniteAnd({-0.1, 1.1}), [](Body& b, double x) { b.interpolated(x); }},
    {"mass", kNotPositive, [](Body& b, double x) { b.setMass({toReal(x), {}, 1}); }},
    {"inertia", kNegative, [](Body& b, double x) { b.setMass({1, {}, toReal(x)}); }},
    {"center", kNotFinite, [](Body& b, double x) { b.setMass({1, vec(x, 0), 1}); }},
    {"force", kNotFinite, [](Body& b, double x) { b.applyForce(vec(x, 0), {0, 0}); }},
    {"force", kNotFinite, [](Body& b, double x) { b.applyForce(vec(0, x), {0, 0}); }},
    {"at", kNoPlace, [](Body& b, double x) { b.applyForce(vec(1, 0), {x, 0}); }},
    {"force", kNotFinite, [](Body& b, double x) { b.applyForceToCenter(vec(x, 0)); }},
    {"force", kNotFinite, [](Body& b, double x) { b.applyForceToCenter(vec(0, x)); }},
    {"torque", kNotFinite, [](Body& b, double x) { b.applyTorque(toReal(x)); }},
    {"impulse", kNotFinite, [](Body& b, double x) { b.applyImpulse(vec(x, 0), {0, 0}); }},
    {"impulse", kNotFinite, [](Body& b, double x) { b.applyImpulse(vec(0, x), {0, 0}); }},
    {"at", kNoPlace, [](Body& b, double x) { b.applyImpulse(vec(1, 0), {0, x}); }},
    {"impulse", kNotFinite, [](Body& b, double x) { b.applyImpulseToCenter(vec(x, 0)); }},
    {"impulse", kNotFinite, [](Body& b, double x) { b.applyAngularImpulse(toReal(x)); }},
    {"force", kNotFinite, [](Body& b, double x) { b.addForce({.force = vec(x, 0)}); }},
    {"point", kNotFinite, [](Body& b, double x) { b.addForce({.force = {}, .point = vec(0, x)}); }},
    {"torque", kNotFinite, [](Body& b, double x) { b.addForce({.force = {}, .torque = toReal(x)}); }},
    {"force", kNotFinite, [](Body& b, double x) { b.setForce(0, {.force = vec(x, 0)}); }},
    {"point", kNotFinite, [](Body& b, double x) { b.setForce(0, {.force = {}, .point = vec(0, x)}); }},
    {"torque", kNotFinite, [](Body& b, double x) { b.setForce(0, {.force = {}, .torque = toReal(x)}); }},
    {"place", {1, 2, 1e9}, [](Body& b, double x) { b.setForce(static_cast<std::size_t>(x), {}); }},
    {"damping", kNegative, [](Body& b, double x) { b.setLinearDamping(toReal(x)); }},
    {"damping", kNegative, [](Body& b, double x) { b.setAngularDamping(toReal(x)); }},
    {"scale", kNotFinite, [](Body& b, double x) { b.setGravityScale(toReal(x)); }},
    {"gravity", kNotFinite, [](Body& b, double x) { b.setOwnGravity(vec(x, 0)); }},
    {"gravity", kNotFinite, [](Body& b, double x) { b.setOwnGravity(vec(0, x)); }},
    {"type", {77}, [](Body& b, double x) { b.setType(static_cast<BodyType>(static_cast<int>(x))); }},
};

TEST(BadInput, EveryCallOfABodyChecksItsNumbers)
{
    TRACES("R4", "R2", "DC-F", "DC-tau", "DC-p", "DC-v", "DC-omega", "DC-phi", "DC-m", "DC-I", "DC-g");
    Everything all;
    for (const auto& entry : kBodyCalls) {
        for (const double value : entry.values) {
            expectRefused(all, "a call of Body, " + caseName(entry, value), entry.field,
                          [&] { entry.put(all.box, value); });
        }
    }
}

struct BodyCall {
    const char* name;
    void (*call)(Body&);
};

// Every member of Body that reads or changes something. id() and isAlive() work on dead handles.
const std::vector<BodyCall> kCallsOfABody = {
    {"definition", [](Body& b) { b.definition(); }},
    {"type", [](Body& b) { b.type(); }},
    {"setType", [](Body& b) { b.setType(BodyType::Static); }},
    {"name", [](Body& b) { b.name(); }},
    {"setName", [](Body& b) { b.setName("x"); }},
    {"userData", [](Body& b) { b.userData(); }},
    {"setUserData", [](Body& b) { b.setUserData(1); }},
    {"isEnabled", [](Body& b) { b.isEnabled(); }},
    {"setEnabled", [](Body& b) { b.setEnabled(false); }},
    {"transform", [](Body& b) { b.transform(); }},
    {"position", [](Body& b) { b.position(); }},
    {"centerOfMass", [](Body& b) { b.centerOfMass(); }},
    {"angle", [](Body& b) { b.angle(); }},
    {"linearVelocity", [](Body& b) { b.linearVelocity(); }},
    {"angularVelocity", [](Body& b) { b.angularVelocity(); }},
    {"velocityAt", [](Body& b) { b.velocityAt({}); }},
    {"setTransform", [](Body& b) { b.setTransform({}, 0); }},
    {"setLinearVelocity", [](Body& b) { b.setLinearVelocity({}); }},
    {"setAngularVelocity", [](Body& b) { b.setAngularVelocity(0); }},
    {"interpolated", [](Body& b) { b.interpolated(0.5); }},
    {"mass", [](Body& b) { b.mass(); }},
    {"inertia", [](Body& b) { b.inertia(); }},
    {"localCenter", [](Body& b) { b.localCenter(); }},
    {"setMass", [](Body& b) { b.setMass({1, {}, 1}); }},
    {"resetMass", [](Body& b) { b.resetMass(); }},
    {"applyForce", [](Body& b) { b.applyForce({}, {}); }},
    {"applyForceToCenter", [](Body& b) { b.applyForceToCenter({}); }},
    {"applyTorque", [](Body& b) { b.applyTorque(0); }},
    {"applyImpulse", [](Body& b) { b.applyImpulse({}, {}); }},
    {"applyImpulseToCenter", [](Body& b) { b.applyImpulseToCenter({}); }},
    {"applyAngularImpulse", [](Body& b) { b.applyAngularImpulse(0); }},
    {"addForce", [](Body& b) { b.addForce({}); }},
    {"lastingForces", [](Body& b) { b.lastingForces(); }},
    {"setForce", [](Body& b) { b.setForce(0, {}); }},
    {"clearForces", [](Body& b) { b.clearForces(); }},
    {"addForceLaw", [](Body& b) { b.addForceLaw(drag(1)); }},
    {"linearDamping", [](Body& b) { b.linearDamping(); }},
    {"setLinearDamping", [](Body& b) { b.setLinearDamping(0); }},
    {"angularDamping", [](Body& b) { b.angularDamping(); }},
    {"setAngularDamping", [](Body& b) { b.setAngularDamping(0); }},
    {"gravityScale", [](Body& b) { b.gravityScale(); }},
    {"setGravityScale", [](Body& b) { b.setGravityScale(1); }},
    {"ownGravity", [](Body& b) { b.ownGravity(); }},
    {"setOwnGravity", [](Body& b) { b.setOwnGravity({}); }},
    {"setLocks", [](Body& b) { b.setLocks(true, true, true); }},
    {"createShape", [](Body& b) { b.createShape({}); }},
    {"shapes", [](Body& b) { b.shapes(); }},
    {"energy", [](Body& b) { b.energy(); }},
    {"momentum", [](Body& b) { b.momentum(); }},
    {"contacts", [](Body& b) { b.contacts(); }},
    {"destroy", [](Body& b) { b.destroy(); }},
};

TEST(BadInput, ADeadOrNullBodyRefusesEveryCall)
{
    TRACES("R4");
    Everything all;
    Body reborn = addDisc(all.world, {6, 6}, 0.5);  // takes the dead body's slot
    EXPECT_EQ(reborn.id().index, all.dead.id().index) << "the lowest free slot should be used again";
    Body null;
    EXPECT_FALSE(all.dead.isAlive());
    EXPECT_FALSE(null.isAlive());
    EXPECT_TRUE(null.id().isNull());
    EXPECT_TRUE(reborn.isAlive());
    for (const BodyCall& entry : kCallsOfABody) {
        expectRefused(all, std::string("dead body, ") + entry.name, "body", [&] { entry.call(all.dead); });
        expectRefused(all, std::string("null body, ") + entry.name, "body", [&] { entry.call(null); });
    }
}

// What a fuzzer would do: any bit pattern in any call. Each is taken or refused, and the world stays sound.
TEST(BadInput, AnyBitPatternInAnyCallLeavesFiniteNumbers)
{
    TRACES("R4");
    const Values wild = {kNaN,   kInfinity, -kInfinity, 0,    -0.0, 1e-320, 1e-45, -1e-30, 1e-7,
                         9.99e5, -9.99e5,   9.99e8,     1e12, 1e30, 3e38,   -3e38, 1e300,  1.7e308};
    for (const double value : wild) {
        Everything all;
        const auto tryCall = [&](auto&& call) {
            try {
                call();
            } catch (const InputError&) {
            }
            all.world.step();
            for (const BodyId id : all.world.bodies()) {
                const Body body = all.world.body(id);
                EXPECT_TRUE(isFinite(body.position()) && isFinite(body.linearVelocity()) &&
                            std::isfinite(body.angularVelocity()) && std::isfinite(body.angle()))
                    << "after a value of " << value;
            }
        };
        for (const auto& entry : kBodyCalls) {
            if (std::string(entry.field) == "type" || std::string(entry.field) == "place") continue;
            tryCall([&] { entry.put(all.box, value); });
        }
        for (const auto& entry : kBodyDefFields) {
            if (std::string(entry.field) == "type") continue;
            BodyDef def;
            def.mass = MassProperties{1, {}, 1};
            entry.put(def, value);
            tryCall([&] { all.world.createBody(def); });
        }
    }
}

}  // namespace
}  // namespace tamias2d
