// SPDX-License-Identifier: MIT
// The published schema says what the library does: the same keys, defaults, names and ranges.
#include "support/build.hpp"
#include "support/traces.hpp"

#include <tamias2d/scene/builtin.hpp>
#include <tamias2d/scene/read.hpp>
#include <tamias2d/scene/write.hpp>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <set>

namespace tamias2d::test {
namespace {

using Json = nlohmann::json;

Json schema()
{
    std::ifstream file(TAMIAS_SOURCE_DIR "/docs/scene.schema.json");
    return Json::parse(file);
}

/// A default world with a default body that has a default shape, a force and joints, all written out.
Json defaults()
{
    World world;
    Body body = world.createBody();
    body.createShape({});
    body.addForce({});
    JointDef joint;
    joint.bodyA = world.createBody().id();
    joint.bodyB = body.id();
    for (const JointKind& kind :
         {JointKind(RevoluteJoint{.limits = JointLimits{}, .motor = JointMotor{}, .spring = JointSpring{}}),
          JointKind(DistanceJoint{}), JointKind(PrismaticJoint{}), JointKind(WeldJoint{}),
          JointKind(TargetJoint{}), JointKind(WheelJoint{}), JointKind(GrooveJoint{}),
          JointKind(RotaryJoint{}), JointKind(RatchetJoint{}), JointKind(GearJoint{}), JointKind(RackJoint{}),
          JointKind(PulleyJoint{}), JointKind(MotorJoint{}), JointKind(FrictionJoint{}),
          JointKind(FilterJoint{})}) {
        joint.kind = kind;
        world.createJoint(joint);
    }
    return Json::parse(writeScene(world, {}, {.everything = true}));
}

std::set<std::string> keysOf(const Json& object)
{
    std::set<std::string> keys;
    for (const auto& item : object.items()) keys.insert(item.key());
    return keys;
}

/// Every key the writer writes is in the schema with that default, and the schema has no others but
/// those in `besides`.
void expectDefaults(const Json& written, const Json& properties, std::set<std::string> besides)
{
    besides.insert("$comment");
    for (const auto& item : written.items()) {
        ASSERT_TRUE(properties.contains(item.key())) << item.key();
        const Json& property = properties[item.key()];
        if (property.contains("default")) {
            EXPECT_EQ(property["default"], item.value()) << item.key() << " in docs/scene.schema.json";
        } else {
            EXPECT_TRUE(item.value().is_structured() || item.value().is_null())
                << item.key() << " has no default";
        }
    }
    std::set<std::string> expected = keysOf(written);
    expected.insert(besides.begin(), besides.end());
    EXPECT_EQ(keysOf(properties), expected);
}

TEST(SceneSchema, HasTheLibrarysKeysAndDefaults)
{
    TRACES("R4", "ADR14");
    const Json all = defaults(), defs = schema()["$defs"];
    const Json& body = all["bodies"][0];
    const Json& shape = body["shapes"][0];
    const auto properties = [&](const char* name) { return defs[name]["properties"]; };

    expectDefaults(all["world"], properties("world"), {});
    expectDefaults(all["world"]["tuning"], properties("tuning"), {});
    expectDefaults(all["run"], properties("run"), {});
    expectDefaults(body, properties("body"), {"laws"});
    expectDefaults(body["locks"], properties("locks"), {});
    expectDefaults(body["forces"][0], properties("force"), {});
    expectDefaults(shape, properties("shape"), {"capsule", "segment", "box", "polygon", "regularPolygon"});
    expectDefaults(shape["filter"], properties("filter"), {});
    expectDefaults(shape["circle"], properties("circle"), {});

    const char* const kinds[] = {"revolute", "distance", "prismatic", "weld",     "target",
                                 "wheel",    "groove",   "rotary",    "ratchet",  "gear",
                                 "rack",     "pulley",   "motor",     "friction", "filter"};
    for (std::size_t i = 0; i < std::size(kinds); ++i) {
        std::set<std::string> besides(std::begin(kinds), std::end(kinds));
        besides.insert({"bodyA", "bodyB"});
        Json joint = all["joints"][i];
        joint.erase("bodyA");
        joint.erase("bodyB");
        const std::string kind = kinds[i];
        const bool isNameOfAPart = kind == "motor" || kind == "filter";
        expectDefaults(joint[kind], properties((isNameOfAPart ? kind + "Joint" : kind).c_str()), {});
        expectDefaults(joint, properties("joint"), besides);
    }
    const Json& parts = all["joints"][0]["revolute"];
    expectDefaults(parts["limits"], properties("limits"), {});
    expectDefaults(parts["motor"], properties("motor"), {});
    expectDefaults(parts["spring"], properties("spring"), {});
    expectDefaults(all["joints"][0]["breaking"], properties("breaking"), {});
}

TEST(SceneSchema, HasTheReadersDefaultsOfGeometry)
{
    TRACES("R4");
    const Json defs = schema()["$defs"];
    for (const char* kind : {"capsule", "segment", "box", "regularPolygon"}) {
        // What an empty object reads as must be what the schema's defaults read as.
        Json full = Json::object();
        for (const auto& item : defs[kind]["properties"].items()) {
            if (item.key() != "$comment") full[item.key()] = item.value()["default"];
        }
        const auto textOf = [&](const Json& geometry) {
            const Json scene = {{"tamias2d", 1}, {"bodies", {{{"shapes", {{{kind, geometry}}}}}}}};
            return writeScene(*readScene(scene.dump()).world);
        };
        EXPECT_EQ(textOf(Json::object()), textOf(full)) << kind;
    }
}

TEST(SceneSchema, KnowsEveryFieldOfEveryDefinition)
{
    TRACES("R4");
    // These lines stop compiling when a definition gains a field; then fields.hpp and the schema want
    // a new key. The number is that of the keys, which may be nested or spread otherwise. WorldDef::lanes is
    // a matter of the machine and not of the scene.
    [[maybe_unused]] const auto& [a1, a2, a3, a4, a5, a6, a7, lanes, threads, tasks, memory] = WorldDef{};
    [[maybe_unused]] const auto& [t1, t2, t3, t4, t5, t6, t7, t8, t9, t10, t11, t12, t13, t14, t15, t16] =
        Tuning{};
    [[maybe_unused]] const auto& [b1, b2, b3, b4, b5, b6, b7, b8, b9, b10, b11, b12, b13, b14, b15, b16, b17,
                                  b18] = BodyDef{};
    [[maybe_unused]] const auto& [s1, s2, s3, s4, s5, s6, s7] = ShapeDef{};
    [[maybe_unused]] const auto& [m1, m2, m3, m4, m5, m6] = Material{};
    [[maybe_unused]] const auto& [f1, f2, f3] = Filter{};
    [[maybe_unused]] const auto& [l1, l2, l3, l4, l5] = LastingForce{};
    [[maybe_unused]] const auto& [p1, p2, p3] = MassProperties{};
    [[maybe_unused]] const auto& [j1, j2, j3, j4, j5, j6, j7, j8, j9] = JointDef{};
    [[maybe_unused]] const auto& [r1, r2, r3, r4, r5, r6, r7] = RevoluteJoint{};
    [[maybe_unused]] const auto& [d1, d2, d3, d4, d5, d6] = DistanceJoint{};
    [[maybe_unused]] const auto& [c1, c2, c3, c4, c5, c6, c7] = PrismaticJoint{};
    [[maybe_unused]] const auto& [w1, w2, w3, w4, w5] = WeldJoint{};
    [[maybe_unused]] const auto& [g1, g2, g3, g4, g5, g6, g7] = TargetJoint{};
    [[maybe_unused]] const auto& [ee1, ee2, ee3, ee4, ee5, ee6] = WheelJoint{};
    [[maybe_unused]] const auto& [ff1, ff2, ff3] = GrooveJoint{};
    [[maybe_unused]] const auto& [gg1, gg2, gg3, gg4, gg5] = RotaryJoint{};
    [[maybe_unused]] const auto& [hh1, hh2] = RatchetJoint{};
    [[maybe_unused]] const auto& [ii1, ii2] = GearJoint{};
    [[maybe_unused]] const auto& [nn1, nn2, nn3, nn4, nn5] = RackJoint{};
    [[maybe_unused]] const auto& [oo1, oo2, oo3, oo4, oo5, oo6, oo7, oo8, oo9] = PulleyJoint{};
    [[maybe_unused]] const auto& [qq1, qq2, qq3, qq4, qq5, qq6, qq7, qq8, qq9] = MotorJoint{};
    [[maybe_unused]] const auto& [uu1, uu2, uu3] = FrictionJoint{};
    [[maybe_unused]] const auto& [x1, x2] = JointLimits{};
    [[maybe_unused]] const auto& [y1, y2] = JointMotor{};
    [[maybe_unused]] const auto& [z1, z2, z3] = JointSpring{};
    [[maybe_unused]] const auto& [k1, k2, k3, k4] = JointBreaking{};

    const Json defs = schema()["$defs"];
    const auto count = [&](const char* name) {
        return defs[name]["properties"].size() - 1;
    };  // less $comment
    EXPECT_EQ(count("world"), 7u);
    EXPECT_EQ(count("tuning"), 16u);
    EXPECT_EQ(count("body"), 18u - 3 + 1 + 3);  // three locks are one key; shapes, forces and laws
    EXPECT_EQ(count("shape"), 7u - 2 + 6 + 6);  // a material's keys and six kinds instead of two fields
    EXPECT_EQ(count("filter"), 3u);
    EXPECT_EQ(count("force"), 5u);
    EXPECT_EQ(count("mass"), 3u);
    EXPECT_EQ(count("joint"), 9u - 2 + 15);  // fifteen kinds instead of one field, no further bodies
    EXPECT_EQ(count("revolute"), 7u);
    EXPECT_EQ(count("distance"), 6u);
    EXPECT_EQ(count("prismatic"), 7u);
    EXPECT_EQ(count("weld"), 5u);
    EXPECT_EQ(count("target"), 7u);
    EXPECT_EQ(count("wheel"), 6u);
    EXPECT_EQ(count("groove"), 3u);
    EXPECT_EQ(count("rotary"), 5u);
    EXPECT_EQ(count("ratchet"), 2u);
    EXPECT_EQ(count("gear"), 2u);
    EXPECT_EQ(count("rack"), 5u);
    EXPECT_EQ(count("pulley"), 9u);
    EXPECT_EQ(count("motorJoint"), 9u);
    EXPECT_EQ(count("friction"), 3u);
    EXPECT_EQ(count("filterJoint"), 0u);
    EXPECT_EQ(count("limits"), 2u);
    EXPECT_EQ(count("motor"), 2u);
    EXPECT_EQ(count("spring"), 3u);
    EXPECT_EQ(count("breaking"), 4u);
}

TEST(SceneSchema, HasTheBuiltInScenesAndTheirRanges)
{
    TRACES("R4");
    const Json list = schema()["$defs"]["builtin"]["oneOf"];
    ASSERT_EQ(list.size(), builtinScenes().size());
    for (std::size_t i = 0; i < list.size(); ++i) {
        const BuiltinScene& scene = builtinScenes()[i];
        const Json& properties = list[i]["properties"];
        EXPECT_EQ(properties["name"]["const"], scene.name);
        EXPECT_EQ(properties.size(), scene.parameters.size() + 2) << scene.name;  // name and $comment
        for (const BuiltinParameter& p : scene.parameters) {
            ASSERT_TRUE(properties.contains(p.name)) << scene.name << "." << p.name;
            const Json& property = properties[p.name];
            const bool isText = p.type == BuiltinParameterType::Choice;
            if (p.standard != "auto") {
                EXPECT_EQ(property["default"], isText ? Json(p.standard) : Json::parse(p.standard)) << p.name;
            }
            if (isText) {
                EXPECT_EQ(property["enum"], Json(p.choices)) << p.name;
            }
            if (property.contains("minimum")) {
                EXPECT_EQ(property["minimum"], p.least) << p.name;
                EXPECT_EQ(property["maximum"], p.most) << p.name;
            }
        }
    }
}

}  // namespace
}  // namespace tamias2d::test
