// SPDX-License-Identifier: MIT
// Every field of WorldDef and Tuning, every call of World and FixedStepper, every built-in force law: wrong
// values are refused by name and nothing changes [R4].
#include "support/refusals.hpp"
#include "support/traces.hpp"

#include <climits>

namespace tamias2d {
namespace {

using namespace test;

const std::vector<BadNumber<Tuning>> kTuningFields = {
    {"restGap", notFiniteAnd({-0.001, 0, 0.11, 1}), [](Tuning& t, double x) { t.restGap = toReal(x); }},
    {"touchingFactor", notFiniteAnd({0.99, 0, -1, 3.01}),
     [](Tuning& t, double x) { t.touchingFactor = toReal(x); }},
    {"pushRate", notFiniteAnd({-0.01, 1.01}), [](Tuning& t, double x) { t.pushRate = toReal(x); }},
    {"pushSpeed", kNotPositive, [](Tuning& t, double x) { t.pushSpeed = toReal(x); }},
    {"pushSlack", notFiniteAnd({-0.01, 1.01}), [](Tuning& t, double x) { t.pushSlack = toReal(x); }},
    {"extraPasses",
     {INT_MIN, -1, 101, INT_MAX},
     [](Tuning& t, double x) { t.extraPasses = static_cast<int>(x); }},
    {"settlingPasses",
     {INT_MIN, -1, 101, INT_MAX},
     [](Tuning& t, double x) { t.settlingPasses = static_cast<int>(x); }},
    {"restless", kNotPositive, [](Tuning& t, double x) { t.restless = toReal(x); }},
    {"quiet", notFiniteAnd({-0.01, 0.2}), [](Tuning& t, double x) { t.quiet = toReal(x); }},
    {"calmRate", notFiniteAnd({-0.01, 1, 2}), [](Tuning& t, double x) { t.calmRate = toReal(x); }},
    {"calmSpeed", kNotPositive, [](Tuning& t, double x) { t.calmSpeed = toReal(x); }},
    {"impactThreshold", notFiniteAnd({0, 0.09, 10.1}),
     [](Tuning& t, double x) { t.impactThreshold = toReal(x); }},
    {"crowd", {INT_MIN, -1, 0, 1000001, INT_MAX}, [](Tuning& t, double x) { t.crowd = static_cast<int>(x); }},
    {"impactsPerContact",
     {INT_MIN, -1, 0, 1, 1001, INT_MAX},
     [](Tuning& t, double x) { t.impactsPerContact = static_cast<int>(x); }},
    {"sleepTime", notFiniteAnd({-0.01, 1.1e6}), [](Tuning& t, double x) { t.sleepTime = toReal(x); }},
    {"sleepSpeed", kNotPositive, [](Tuning& t, double x) { t.sleepSpeed = toReal(x); }},
};

const std::vector<BadNumber<WorldDef>> kWorldDefFields = {
    {"gravity", kNotFinite, [](WorldDef& d, double x) { d.gravity.x = toReal(x); }},
    {"gravity", kNotFinite, [](WorldDef& d, double x) { d.gravity.y = toReal(x); }},
    {"gravitationConstant", kNegative, [](WorldDef& d, double x) { d.gravitationConstant = toReal(x); }},
    {"lengthUnit", kNotPositive, [](WorldDef& d, double x) { d.lengthUnit = toReal(x); }},
    {"frictionMixing",
     {0, 6, 77},
     [](WorldDef& d, double x) { d.frictionMixing = static_cast<MixingRule>(static_cast<int>(x)); }},
    {"restitutionMixing",
     {0, 6, 77},
     [](WorldDef& d, double x) { d.restitutionMixing = static_cast<MixingRule>(static_cast<int>(x)); }},
    {"lanes", {5, 77}, [](WorldDef& d, double x) { d.lanes = static_cast<LaneWidth>(static_cast<int>(x)); }},
};

TEST(BadInput, EveryFieldOfAWorldDefinitionIsChecked)
{
    TRACES("R4", "R1", "DC-g");
    for (const auto& entry : kWorldDefFields) {
        for (const double value : entry.values) {
            WorldDef def;
            entry.put(def, value);
            expectInputError("World, " + caseName(entry, value), entry.field, [&] { World world(def); });
        }
    }
}

TEST(BadInput, EveryTuningConstantIsChecked)
{
    TRACES("R4");
    Everything all;
    for (const auto& entry : kTuningFields) {
        for (const double value : entry.values) {
            WorldDef def;
            entry.put(def.tuning, value);
            expectInputError("World, " + caseName(entry, value), entry.field, [&] { World world(def); });
            expectRefused(all, "setTuning, " + caseName(entry, value), entry.field,
                          [&] { all.world.setTuning(def.tuning); });
        }
    }
}

TEST(BadInput, TheSettersOfAWorldCheckTheirNumbers)
{
    TRACES("R4", "DC-g", "T3");
    Everything all;
    for (const double bad : kNotFinite) {
        expectRefused(all, "setGravity", "gravity", [&] { all.world.setGravity(vec(bad, 0)); });
        expectRefused(all, "setGravity", "gravity", [&] { all.world.setGravity(vec(0, bad)); });
    }
    for (const double bad : kNegative) {
        expectRefused(all, "setGravitationConstant", "gravitationConstant",
                      [&] { all.world.setGravitationConstant(toReal(bad)); });
    }
    for (const int bad : {0, 6, 77}) {
        const auto rule = static_cast<MixingRule>(bad);
        expectRefused(all, "setMixingRules", "friction",
                      [&] { all.world.setMixingRules(rule, MixingRule::Average); });
        expectRefused(all, "setMixingRules", "restitution",
                      [&] { all.world.setMixingRules(MixingRule::Average, rule); });
    }
}

TEST(BadInput, IdsThatAreNullDeadOrOfAnotherWorldAreRefused)
{
    TRACES("R4", "R1");
    Everything all;
    World& w = all.world;
    const BodyId bodies[] = {
        BodyId{}, all.dead.id(), all.foreign.id(), {0, 12345, all.box.id().world}, {~0u, 1, 0}};
    for (const BodyId id : bodies) {
        EXPECT_FALSE(w.findBody(id).has_value());
        expectRefused(all, "body", "body", [&] { w.body(id); });
        expectRefused(all, "destroyBody", "body", [&] { w.destroyBody(id); });
        expectRefused(all, "touching", "a", [&] { w.touching(id, all.box.id()); });
        expectRefused(all, "touching", "b", [&] { w.touching(all.box.id(), id); });
        const std::array<BodyId, 2> ids = {all.box.id(), id};
        std::array<BodyState, 2> states{};
        expectRefused(all, "readStates", "ids", [&] { w.readStates(ids, states); });
        expectRefused(all, "writeStates", "ids", [&] { w.writeStates(ids, states); });
    }
    const ShapeId shapes[] = {
        ShapeId{}, all.deadShape.id(), all.foreignShape.id(), {0, 12345, all.box.id().world}};
    for (const ShapeId id : shapes) {
        EXPECT_FALSE(w.findShape(id).has_value());
        expectRefused(all, "shape", "shape", [&] { w.shape(id); });
        expectRefused(all, "touching", "a", [&] { w.touching(id, all.boxShape.id()); });
        expectRefused(all, "touching", "b", [&] { w.touching(all.boxShape.id(), id); });
    }
    const ForceLawId foreignLaw = all.other.addForceLaw(drag(1));
    for (const ForceLawId id : {ForceLawId{}, all.deadLaw, foreignLaw}) {
        expectRefused(all, "removeForceLaw", "law", [&] { w.removeForceLaw(id); });
    }
    EXPECT_TRUE(all.foreign.isAlive());
}

TEST(BadInput, StatesAreWrittenAllOrNone)
{
    TRACES("R4", "DC-p", "DC-v", "DC-omega", "DC-phi");
    Everything all;
    const std::array<BodyId, 2> ids = {all.box.id(), all.disc.id()};
    std::array<BodyState, 2> good{};
    all.world.readStates(ids, good);
    good[0].position = {7, 7};
    const std::vector<BadNumber<BodyState>> fields = {
        {"position", kNoPlace, [](BodyState& s, double x) { s.position.x = x; }},
        {"angle", kNotFinite, [](BodyState& s, double x) { s.angle = x; }},
        {"linearVelocity", kNoSpeed, [](BodyState& s, double x) { s.linearVelocity.y = toReal(x); }},
        {"angularVelocity", kNoSpeed, [](BodyState& s, double x) { s.angularVelocity = toReal(x); }},
    };
    for (const auto& entry : fields) {
        for (const double value : entry.values) {
            auto states = good;
            entry.put(states[1], value);
            expectRefused(all, "writeStates, " + caseName(entry, value), entry.field,
                          [&] { all.world.writeStates(ids, states); });
        }
    }
    std::array<BodyState, 3> tooMany{};
    expectRefused(all, "writeStates", "states", [&] { all.world.writeStates(ids, tooMany); });
    expectRefused(all, "readStates", "states", [&] { all.world.readStates(ids, tooMany); });
    expectRefused(all, "writeStates", "states", [&] { all.world.writeStates(ids, {}); });
    expectRefused(all, "readStates", "states", [&] { all.world.readStates(ids, {}); });
}

TEST(BadInput, QueriesCheckTheirPlaces)
{
    TRACES("R4", "R7");
    Everything all;
    const World& w = all.world;
    for (const double bad : kNotFinite) {
        expectRefused(all, "queryPoint", "point", [&] { w.queryPoint({bad, 0}); });
        expectRefused(all, "queryBox", "box", [&] { w.queryBox({{bad, 0}, {1, 1}}); });
        expectRefused(all, "queryBox", "box", [&] { w.queryBox({{0, 0}, {1, bad}}); });
        expectRefused(all, "castRay", "from", [&] { w.castRay({bad, 0}, {1, 1}); });
        expectRefused(all, "castRay", "to", [&] { w.castRay({0, 0}, {1, bad}); });
        expectRefused(all, "castRayAll", "from", [&] { w.castRayAll({bad, 0}, {1, 1}); });
        expectRefused(all, "castRayAll", "to", [&] { w.castRayAll({0, 0}, {1, bad}); });
    }
    expectRefused(all, "queryBox, upside down", "box", [&] { w.queryBox({{0, 1}, {1, 0}}); });
}

TEST(BadInput, ABadTimeStepIsReportedAndMovesNothing)
{
    TRACES("R4");
    Everything all;
    const std::string before = describe(all.world);
    const std::uint64_t hash = all.world.stateHash();
    const auto expectNothing = [&](double dt, int substeps) {
        EXPECT_EQ(all.world.step(dt, substeps).status, StepStatus::BadTimeStep) << dt << " s x " << substeps;
        EXPECT_EQ(all.world.lastReport().status, StepStatus::BadTimeStep) << dt << " s x " << substeps;
        EXPECT_EQ(all.world.stateHash(), hash) << dt << " s x " << substeps;
        EXPECT_EQ(describe(all.world), before) << dt << " s x " << substeps;
    };
    for (const double dt : notFiniteAnd({0, -0.0, -1.0 / 60, 1.0000001, 1e300})) expectNothing(dt, 4);
    for (const int substeps : {INT_MIN, -1, 0, 257, INT_MAX}) expectNothing(1.0 / 60, substeps);
    EXPECT_EQ(all.world.step(1, 256).status, StepStatus::Done);
    EXPECT_EQ(all.world.step(1e-9, 1).status, StepStatus::Done);
    EXPECT_NE(all.world.stateHash(), hash);
}

TEST(BadInput, AFixedStepperChecksItsNumbers)
{
    TRACES("R4");
    for (const double bad : notFiniteAnd({0, -1, 1.1})) {
        expectInputError("FixedStepper", "step", [&] { FixedStepper stepper(bad); });
    }
    for (const int bad : {INT_MIN, -1, 0, 257, INT_MAX}) {
        expectInputError("FixedStepper", "substeps", [&] { FixedStepper stepper(1.0 / 60, bad); });
    }
    for (const double bad : {kNaN, -kInfinity, -1.0, 0.0, 0.01}) {
        expectInputError("FixedStepper", "maxFrame", [&] { FixedStepper stepper(1.0 / 60, 4, bad); });
    }
    Everything all;
    FixedStepper stepper;
    for (const double bad : notFiniteAnd({-1e-9, -1})) {
        expectRefused(all, "advance", "seconds", [&] { stepper.advance(all.world, bad); });
        EXPECT_EQ(stepper.alpha(), 0.0);
        EXPECT_EQ(stepper.dropped(), 0.0);
    }
}

TEST(BadInput, TheBuiltInForceLawsCheckTheirNumbers)
{
    TRACES("R4", "DC-F", "T3");
    for (const double bad : kNotFinite) {
        expectInputError("springTo", "point", [&] { springTo({bad, 0}, 1); });
        expectInputError("attractionTo", "point", [&] { attractionTo({0, bad}, 1); });
        expectInputError("attractionTo", "mu", [&] { attractionTo({0, 0}, bad); });
        expectInputError("torsionSpring", "angle", [&] { torsionSpring(bad, 1); });
    }
    for (const double bad : kNegative) {
        expectInputError("springTo", "stiffness", [&] { springTo({}, bad); });
        expectInputError("springTo", "damping", [&] { springTo({}, 1, bad); });
        expectInputError("attractionTo", "softening", [&] { attractionTo({}, 1, bad); });
        expectInputError("drag", "linear", [&] { drag(bad); });
        expectInputError("drag", "quadratic", [&] { drag(1, bad); });
        expectInputError("torsionSpring", "stiffness", [&] { torsionSpring(0, bad); });
        expectInputError("torsionSpring", "damping", [&] { torsionSpring(0, 1, bad); });
    }
}

TEST(BadInput, AForceLawWithoutAForceIsRefused)
{
    TRACES("R4");
    Everything all;
    ForceLaw law;
    law.name = "nothing";
    expectRefused(all, "World::addForceLaw", "force", [&] { all.world.addForceLaw(law); });
    expectRefused(all, "Body::addForceLaw", "force", [&] { all.box.addForceLaw(law); });
}

TEST(BadInput, TheBoundsOfLengthsFollowTheLengthUnit)
{
    TRACES("R4", "DC-L", "DC-p", "DC-v");
    WorldDef def;
    def.lengthUnit = 100;
    World world(def);
    Body body = world.createBody({.position = {9.9e10, -9.9e10}, .linearVelocity = vec(9.9e7, 0)});
    EXPECT_EQ(body.position().x, 9.9e10);
    body.createShape({.geometry = Circle{{}, toReal(9.9e7)}});
    body.createShape({.geometry = Circle{{}, toReal(1.1e-4)}});
    expectInputError("createShape", "radius",
                     [&] { body.createShape({.geometry = Circle{{}, toReal(0.9e-4)}}); });
    expectInputError("createShape", "radius",
                     [&] { body.createShape({.geometry = Circle{{}, toReal(1.1e8)}}); });
    expectInputError("createBody", "position", [&] { world.createBody({.position = {1.1e11, 0}}); });
    expectInputError("setLinearVelocity", "velocity", [&] { body.setLinearVelocity(vec(1.1e8, 0)); });
    expectInputError("setAngularVelocity", "velocity", [&] { body.setAngularVelocity(toReal(1.1e6)); });
}

int calls = 0;

TEST(BadInput, AnErrorHandlerIsForBuildsWithoutExceptions)
{
    TRACES("R4");
    const ErrorHandler before = setErrorHandler([](const InputError&) { ++calls; });
    World world;
    expectInputError("setGravity", "gravity", [&] { world.setGravity(vec(kNaN, 0)); });
    EXPECT_EQ(calls, 0) << "with exceptions, an error is thrown and the handler is left alone";
    EXPECT_NE(setErrorHandler(before), nullptr);
}

}  // namespace
}  // namespace tamias2d
