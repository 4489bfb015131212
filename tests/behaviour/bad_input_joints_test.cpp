// SPDX-License-Identifier: MIT
// Every field of every kind of joint with every kind of wrong value: refused by name, nothing changed [R4].
#include "support/refusals.hpp"
#include "support/traces.hpp"

namespace tamias2d {
namespace {

using namespace test;

const Values kNoAnchor = notFiniteAnd({1.1e6, -1.1e6});
const Values kNoAngle = notFiniteAnd({1.1e6, -1.1e6});
const Values kNoForce = notFiniteAnd({-1, -1e-30, 1.1e30});
const Values kNoFrequency = notFiniteAnd({-1, -1e-30, 1.1e6});
const Values kNoStrength = notFiniteAnd({-1, 0, 1.1e30});
const Values kNoTurns = {-100001, 100001, 2e9};
const Values kNoWindow = notFiniteAnd({-1e-6, -1, 1.1e30});

// One world with two bodies that may be joined, and a joint of each kind.
struct Joined : Everything {
    JointDef def;
    Joint hinge;
    Joined()
    {
        def.bodyA = ground.id();
        def.bodyB = box.id();
        hinge = world.createJoint(revoluteAt(ground, disc, {3, 2}));
    }
};

template <class Kind>
void expectEveryFieldChecked(const std::vector<BadNumber<Kind>>& fields, const char* name)
{
    Joined all;
    for (const auto& entry : fields) {
        for (const double value : entry.values) {
            Kind kind;
            entry.put(kind, value);
            JointDef def = all.def;
            def.kind = kind;
            const std::string what = std::string(name) + ", " + caseName(entry, value);
            expectRefused(all, "createJoint, " + what, entry.field, [&] { all.world.createJoint(def); });
            expectRefused(all, "setKind, " + what, entry.field, [&] { all.hinge.setKind(kind); });
            expectRefused(all, what, name, [&] { all.world.createJoint(def); });
        }
    }
}

// What all kinds with a free coordinate have.
template <class Kind>
std::vector<BadNumber<Kind>> withParts(std::vector<BadNumber<Kind>> fields)
{
    const std::vector<BadNumber<Kind>> common = {
        {"anchorA", kNoAnchor, [](Kind& k, double x) { k.anchorA.x = toReal(x); }},
        {"anchorA", kNoAnchor, [](Kind& k, double x) { k.anchorA.y = toReal(x); }},
        {"anchorB", kNoAnchor, [](Kind& k, double x) { k.anchorB.x = toReal(x); }},
        {"anchorB", kNoAnchor, [](Kind& k, double x) { k.anchorB.y = toReal(x); }},
        {"limits.lower", kNoAnchor, [](Kind& k, double x) { k.limits = JointLimits{toReal(x), toReal(x)}; }},
        {"limits.upper", kNoAnchor, [](Kind& k, double x) { k.limits = JointLimits{0, toReal(x)}; }},
        {"limits.lower", {1.5}, [](Kind& k, double x) { k.limits = JointLimits{toReal(x), 1}; }},
        {"motor.speed", kNoSpeed, [](Kind& k, double x) { k.motor = JointMotor{toReal(x), 1}; }},
        {"motor.maxForce", kNoForce, [](Kind& k, double x) { k.motor = JointMotor{1, toReal(x)}; }},
        {"spring.frequency", kNoFrequency,
         [](Kind& k, double x) { k.spring = JointSpring{toReal(x), 0, 1}; }},
        {"spring.dampingRatio", kNoFrequency,
         [](Kind& k, double x) { k.spring = JointSpring{1, toReal(x), 1}; }},
        {"spring.rest", kNoAnchor, [](Kind& k, double x) { k.spring = JointSpring{1, 0, toReal(x)}; }},
    };
    fields.insert(fields.end(), common.begin(), common.end());
    return fields;
}

TEST(BadInput, EveryFieldOfARevoluteJointIsChecked)
{
    TRACES("R4", "LC3");
    expectEveryFieldChecked<RevoluteJoint>(
        withParts<RevoluteJoint>(
            {{"referenceAngle", kNoAngle, [](RevoluteJoint& k, double x) { k.referenceAngle = x; }},
             {"turns", kNoTurns, [](RevoluteJoint& k, double x) { k.turns = static_cast<int>(x); }}}),
        "RevoluteJoint");
}

TEST(BadInput, EveryFieldOfADistanceJointIsChecked)
{
    TRACES("R4", "LC3", "DC-L");
    expectEveryFieldChecked<DistanceJoint>(
        withParts<DistanceJoint>(
            {{"length", kNoSize, [](DistanceJoint& k, double x) { k.length = toReal(x); }},
             {"limits.lower", {-1}, [](DistanceJoint& k, double x) { k.limits = JointLimits{toReal(x), 1}; }},
             {"limits.upper", {0}, [](DistanceJoint& k, double x) { k.limits = JointLimits{0, toReal(x)}; }},
             {"spring.rest",
              {-1},
              [](DistanceJoint& k, double x) { k.spring = JointSpring{1, 0, toReal(x)}; }}}),
        "DistanceJoint");
}

TEST(BadInput, EveryFieldOfAPrismaticJointIsChecked)
{
    TRACES("R4", "LC3");
    expectEveryFieldChecked<PrismaticJoint>(
        withParts<PrismaticJoint>(
            {{"axis", notFiniteAnd({0, 1e-7, 1.1e6}),
              [](PrismaticJoint& k, double x) { k.axis = vec(x, 0); }},
             {"axis", notFiniteAnd({0}), [](PrismaticJoint& k, double x) { k.axis = vec(0, x); }},
             {"referenceAngle", kNoAngle, [](PrismaticJoint& k, double x) { k.referenceAngle = x; }}}),
        "PrismaticJoint");
}

TEST(BadInput, EveryFieldOfAWeldJointIsChecked)
{
    TRACES("R4", "LC3");
    using K = WeldJoint;
    expectEveryFieldChecked<K>(
        {{"anchorA", kNoAnchor, [](K& k, double x) { k.anchorA = vec(x, 0); }},
         {"anchorB", kNoAnchor, [](K& k, double x) { k.anchorB = vec(0, x); }},
         {"referenceAngle", kNoAngle, [](K& k, double x) { k.referenceAngle = x; }},
         {"linear.frequency", kNoFrequency, [](K& k, double x) { k.linear = JointSpring{toReal(x), 0, 0}; }},
         {"linear.dampingRatio", kNoFrequency,
          [](K& k, double x) { k.linear = JointSpring{1, toReal(x), 0}; }},
         {"linear.rest", notFiniteAnd({1}), [](K& k, double x) { k.linear = JointSpring{1, 0, toReal(x)}; }},
         {"angular.frequency", kNoFrequency,
          [](K& k, double x) { k.angular = JointSpring{toReal(x), 0, 0}; }},
         {"angular.dampingRatio", kNoFrequency,
          [](K& k, double x) { k.angular = JointSpring{1, toReal(x), 0}; }},
         {"angular.rest", notFiniteAnd({1}),
          [](K& k, double x) { k.angular = JointSpring{1, 0, toReal(x)}; }}},
        "WeldJoint");
}

TEST(BadInput, EveryFieldOfAWheelJointIsChecked)
{
    TRACES("R4", "LC3");
    using K = WheelJoint;
    expectEveryFieldChecked<K>(
        withParts<K>({{"axis", notFiniteAnd({0, 1e-7, 1.1e6}), [](K& k, double x) { k.axis = vec(x, 0); }},
                      {"axis", notFiniteAnd({0}), [](K& k, double x) { k.axis = vec(0, x); }}}),
        "WheelJoint");
}

TEST(BadInput, EveryFieldOfAGrooveJointIsChecked)
{
    TRACES("R4", "LC3");
    using K = GrooveJoint;
    expectEveryFieldChecked<K>({{"start", kNoAnchor, [](K& k, double x) { k.start = vec(x, 0); }},
                                {"start", kNoAnchor, [](K& k, double x) { k.start = vec(0, x); }},
                                {"end", kNoAnchor, [](K& k, double x) { k.end = vec(x, 0); }},
                                {"end", kNoAnchor, [](K& k, double x) { k.end = vec(0, x); }},
                                {"end", {-1}, [](K& k, double x) { k.end = vec(x, 0); }},  // at start
                                {"anchorB", kNoAnchor, [](K& k, double x) { k.anchorB = vec(x, 0); }},
                                {"anchorB", kNoAnchor, [](K& k, double x) { k.anchorB = vec(0, x); }}},
                               "GrooveJoint");
}

TEST(BadInput, EveryFieldOfARotaryJointIsChecked)
{
    TRACES("R4", "LC3");
    using K = RotaryJoint;
    expectEveryFieldChecked<K>(
        {{"referenceAngle", kNoAngle, [](K& k, double x) { k.referenceAngle = x; }},
         {"turns", kNoTurns, [](K& k, double x) { k.turns = static_cast<int>(x); }},
         {"limits.lower", kNoAnchor, [](K& k, double x) { k.limits = JointLimits{toReal(x), toReal(x)}; }},
         {"limits.upper", kNoAnchor, [](K& k, double x) { k.limits = JointLimits{0, toReal(x)}; }},
         {"limits.lower", {1.5}, [](K& k, double x) { k.limits = JointLimits{toReal(x), 1}; }},
         {"motor.speed", kNoSpeed, [](K& k, double x) { k.motor = JointMotor{toReal(x), 1}; }},
         {"motor.maxForce", kNoForce, [](K& k, double x) { k.motor = JointMotor{1, toReal(x)}; }},
         {"spring.frequency", kNoFrequency, [](K& k, double x) { k.spring = JointSpring{toReal(x), 0, 1}; }},
         {"spring.dampingRatio", kNoFrequency,
          [](K& k, double x) { k.spring = JointSpring{1, toReal(x), 1}; }},
         {"spring.rest", kNoAnchor, [](K& k, double x) { k.spring = JointSpring{1, 0, toReal(x)}; }}},
        "RotaryJoint");
}

TEST(BadInput, EveryFieldOfRatchetsAndGearsIsChecked)
{
    TRACES("R4", "LC3");
    const Values noFactor = notFiniteAnd({0, 0.9e-3, -0.9e-3, 1.1e3, -1.1e3});
    const Values noPhase = notFiniteAnd({1.1e9, -1.1e9});
    expectEveryFieldChecked<RatchetJoint>(
        {{"referenceAngle", kNoAngle, [](RatchetJoint& k, double x) { k.referenceAngle = x; }},
         {"tooth", noFactor, [](RatchetJoint& k, double x) { k.tooth = toReal(x); }}},
        "RatchetJoint");
    expectEveryFieldChecked<GearJoint>(
        {{"ratio", noFactor, [](GearJoint& k, double x) { k.ratio = toReal(x); }},
         {"phase", noPhase, [](GearJoint& k, double x) { k.phase = x; }}},
        "GearJoint");
}

TEST(BadInput, EveryFieldOfARackJointIsChecked)
{
    TRACES("R4", "LC3");
    using K = RackJoint;
    expectEveryFieldChecked<K>(
        {{"anchorA", kNoAnchor, [](K& k, double x) { k.anchorA = vec(x, 0); }},
         {"anchorB", kNoAnchor, [](K& k, double x) { k.anchorB = vec(0, x); }},
         {"axis", notFiniteAnd({0, 1e-7, 1.1e6}), [](K& k, double x) { k.axis = vec(x, 0); }},
         {"radius", notFiniteAnd({0, 0.9e-6, -0.9e-6, 1.1e6}), [](K& k, double x) { k.radius = toReal(x); }},
         {"offset", notFiniteAnd({1.1e9, -1.1e9}), [](K& k, double x) { k.offset = x; }}},
        "RackJoint");
}

TEST(BadInput, EveryFieldOfAPulleyJointIsChecked)
{
    TRACES("R4", "LC3", "DC-L", "DC-p");
    using K = PulleyJoint;
    expectEveryFieldChecked<K>(
        {{"anchorA", kNoAnchor, [](K& k, double x) { k.anchorA = vec(x, 0); }},
         {"anchorB", kNoAnchor, [](K& k, double x) { k.anchorB = vec(0, x); }},
         {"wheelA", kNoPlace, [](K& k, double x) { k.wheelA.x = x; }},
         {"wheelA", kNoPlace, [](K& k, double x) { k.wheelA.y = x; }},
         {"wheelB", kNoPlace, [](K& k, double x) { k.wheelB.x = x; }},
         {"wheelB", kNoPlace, [](K& k, double x) { k.wheelB.y = x; }},
         {"ratio", notFiniteAnd({-1, 0, 0.9e-3, 1.1e3}), [](K& k, double x) { k.ratio = toReal(x); }},
         {"length", kNoSize, [](K& k, double x) { k.length = toReal(x); }},
         {"stopA", kNoSize, [](K& k, double x) { k.stopA = toReal(x); }},
         {"stopB", kNoSize, [](K& k, double x) { k.stopB = toReal(x); }},
         {"length", {1.96}, [](K& k, double x) { k.stopA = toReal(x); }}},  // more rope than there is
        "PulleyJoint");
}

TEST(BadInput, EveryFieldOfAMotorJointIsChecked)
{
    TRACES("R4", "LC3");
    using K = MotorJoint;
    expectEveryFieldChecked<K>(
        {{"anchorA", kNoAnchor, [](K& k, double x) { k.anchorA = vec(x, 0); }},
         {"anchorB", kNoAnchor, [](K& k, double x) { k.anchorB = vec(0, x); }},
         {"referenceAngle", kNoAngle, [](K& k, double x) { k.referenceAngle = x; }},
         {"linear.frequency", kNoFrequency, [](K& k, double x) { k.linear = JointSpring{toReal(x), 0, 0}; }},
         {"linear.dampingRatio", kNoFrequency,
          [](K& k, double x) { k.linear = JointSpring{1, toReal(x), 0}; }},
         {"linear.rest", notFiniteAnd({1}), [](K& k, double x) { k.linear = JointSpring{1, 0, toReal(x)}; }},
         {"angular.frequency", kNoFrequency,
          [](K& k, double x) { k.angular = JointSpring{toReal(x), 0, 0}; }},
         {"angular.dampingRatio", kNoFrequency,
          [](K& k, double x) { k.angular = JointSpring{1, toReal(x), 0}; }},
         {"angular.rest", notFiniteAnd({1}),
          [](K& k, double x) { k.angular = JointSpring{1, 0, toReal(x)}; }},
         {"velocity", kNoSpeed, [](K& k, double x) { k.velocity = vec(x, 0); }},
         {"velocity", kNoSpeed, [](K& k, double x) { k.velocity = vec(0, x); }},
         {"spin", kNoSpeed, [](K& k, double x) { k.spin = toReal(x); }},
         {"maxForce", kNoForce, [](K& k, double x) { k.maxForce = toReal(x); }},
         {"maxTorque", kNoForce, [](K& k, double x) { k.maxTorque = toReal(x); }}},
        "MotorJoint");
}

TEST(BadInput, EveryFieldOfAFrictionJointIsChecked)
{
    TRACES("R4", "LC3");
    using K = FrictionJoint;
    expectEveryFieldChecked<K>({{"anchor", kNoAnchor, [](K& k, double x) { k.anchor = vec(x, 0); }},
                                {"anchor", kNoAnchor, [](K& k, double x) { k.anchor = vec(0, x); }},
                                {"maxForce", kNoForce, [](K& k, double x) { k.maxForce = toReal(x); }},
                                {"maxTorque", kNoForce, [](K& k, double x) { k.maxTorque = toReal(x); }}},
                               "FrictionJoint");
}

TEST(BadInput, EveryFieldOfATargetJointIsChecked)
{
    TRACES("R4", "LC3", "DC-p");
    using K = TargetJoint;
    expectEveryFieldChecked<K>(
        {{"anchor", kNoAnchor, [](K& k, double x) { k.anchor = vec(x, 0); }},
         {"target", kNoPlace, [](K& k, double x) { k.target.x = x; }},
         {"target", kNoPlace, [](K& k, double x) { k.target.y = x; }},
         {"angle", kNoAngle, [](K& k, double x) { k.angle = x; }},
         {"frequency", notFiniteAnd({0, -1, 1.1e6}), [](K& k, double x) { k.frequency = toReal(x); }},
         {"dampingRatio", kNoFrequency, [](K& k, double x) { k.dampingRatio = toReal(x); }},
         {"maxForce", kNoForce, [](K& k, double x) { k.maxForce = toReal(x); }},
         {"maxTorque", kNoForce, [](K& k, double x) { k.maxTorque = toReal(x); }}},
        "TargetJoint");
}

TEST(BadInput, TheStrengthOfAJointIsChecked)
{
    TRACES("R4", "LC3");
    Joined all;
    const std::vector<BadNumber<JointBreaking>> fields = {
        {"force", kNoStrength, [](JointBreaking& b, double x) { b.force = toReal(x); }},
        {"torque", kNoStrength, [](JointBreaking& b, double x) { b.torque = toReal(x); }},
        {"error", kNoStrength, [](JointBreaking& b, double x) { b.error = toReal(x); }},
        {"window", kNoWindow, [](JointBreaking& b, double x) { b.window = toReal(x); }},
    };
    for (const auto& entry : fields) {
        for (const double value : entry.values) {
            JointDef def = all.def;
            entry.put(def.breaking, value);
            expectRefused(all, "createJoint, " + caseName(entry, value), entry.field,
                          [&] { all.world.createJoint(def); });
            expectRefused(all, "setBreaking, " + caseName(entry, value), entry.field,
                          [&] { all.hinge.setBreaking(def.breaking); });
        }
    }
}

TEST(BadInput, TheBodiesOfAJointMustBeTwoLiveOnesAndOneOfThemDynamic)
{
    TRACES("R4", "LC3");
    Joined all;
    const auto refused = [&](const Body& a, const Body& b, const char* field) {
        JointDef def = all.def;
        def.bodyA = a.id();
        def.bodyB = b.id();
        expectRefused(all, "createJoint", field, [&] { all.world.createJoint(def); });
    };
    refused(all.dead, all.box, "bodyA");
    refused(all.box, all.dead, "bodyB");
    refused(Body{}, all.box, "bodyA");
    refused(all.box, Body{}, "bodyB");
    refused(all.foreign, all.box, "bodyA");
    refused(all.box, all.foreign, "bodyB");
    refused(all.box, all.box, "bodyB");
    refused(all.ground, all.platform, "bodyB");
    refused(all.platform, all.ground, "bodyB");
}

TEST(BadInput, ADeadJointRefusesEveryCall)
{
    TRACES("R4", "LC3");
    Joined all;
    Joint dead = all.hinge;
    const JointId id = dead.id();
    dead.destroy();
    using Call = void (*)(Joint&);
    const std::vector<Call> calls = {
        [](Joint& j) { j.definition(); },
        [](Joint& j) { j.bodyA(); },
        [](Joint& j) { j.bodyB(); },
        [](Joint& j) { j.name(); },
        [](Joint& j) { j.setName("x"); },
        [](Joint& j) { j.userData(); },
        [](Joint& j) { j.setUserData(1); },
        [](Joint& j) { j.kind(); },
        [](Joint& j) { j.setKind({}); },
        [](Joint& j) { j.isEnabled(); },
        [](Joint& j) { j.setEnabled(true); },
        [](Joint& j) { j.isBroken(); },
        [](Joint& j) { j.collidesConnected(); },
        [](Joint& j) { j.setCollideConnected(true); },
        [](Joint& j) { j.breaking(); },
        [](Joint& j) { j.setBreaking({}); },
        [](Joint& j) { j.setMotorSpeed(1); },
        [](Joint& j) { j.setTarget({}); },
        [](Joint& j) { j.anchorA(); },
        [](Joint& j) { j.anchorB(); },
        [](Joint& j) { j.reading(); },
        [](Joint& j) { j.destroy(); },
    };
    Joint null;
    for (const Call call : calls) {
        expectRefused(all, "a call of a dead joint", "Joint", [&] { call(dead); });
        expectRefused(all, "a call of a null joint", "Joint", [&] { call(null); });
    }
    expectRefused(all, "World::joint", "JointId", [&] { all.world.joint(id); });
    expectRefused(all, "World::destroyJoint", "JointId", [&] { all.world.destroyJoint(id); });
    EXPECT_FALSE(all.world.findJoint(id));
}

TEST(BadInput, ShorthandsOfAJointRefuseWhatItHasNot)
{
    TRACES("R4", "LC3");
    Joined all;
    expectRefused(all, "setMotorSpeed", "speed", [&] { all.hinge.setMotorSpeed(1); });
    expectRefused(all, "setTarget", "target", [&] { all.hinge.setTarget({1, 1}); });
}

}  // namespace
}  // namespace tamias2d
