// SPDX-License-Identifier: MIT
// A scene file with a fault is told where and why, in one line that a person can act on [R4].
#include "support/build.hpp"
#include "support/traces.hpp"

#include <tamias2d/scene/read.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace tamias2d::test {
namespace {

struct Broken {
    const char* text;
    const char* message;
};

/// A scene with one body of one shape on line 3.
std::string withShape(const std::string& shape)
{
    return "{\"tamias2d\": 1,\n \"bodies\": [\n {\"shapes\": [{" + shape + "}]}]}";
}
std::string withBody(const std::string& body)
{
    return "{\"tamias2d\": 1,\n \"bodies\": [\n {" + body + "}]}";
}

std::string messageOfScene(const std::string& text)
{
    try {
        readScene(text, "s.json");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "(no error)";
}

template <class Wrap>
void expectAll(const std::vector<Broken>& table, Wrap wrap)
{
    for (const Broken& broken : table) {
        EXPECT_EQ(messageOfScene(wrap(broken.text)), std::string("s.json:") + broken.message) << broken.text;
    }
}

std::string asItIs(const std::string& text)
{
    return text;
}

TEST(BrokenScene, TextThatIsNoJsonIsToldByLineAndColumn)
{
    TRACES("R4", "ADR14");
    expectAll(
        {
            {"",
             "1:1: not valid JSON: syntax error while parsing value - unexpected end of input; expected '[', "
             "'{', or a literal"},
            {"{\"tamias2d\": 1,\n  }",
             "2:3: not valid JSON: syntax error while parsing object key - unexpected '}'; "
             "expected string literal"},
            {"{\"tamias2d\": 1,\n \"x\": NaN}", "2:7: not valid JSON: syntax error while parsing value - "
                                                "invalid literal; last read: '\"x\": N'"},
            {"{\"tamias2d\": 1e999}", "1:18: not valid JSON: number overflow parsing '1e999'"},
            {"{\"tamias2d\": 1} 2",
             "1:17: not valid JSON: syntax error while parsing value - unexpected number "
             "literal; expected end of input"},
            {"{\"tamias2d\": 1,\n \"run\": {\"rate\": 60,\n \"rate\": 30}}",
             "3: /run/rate: must not be there twice"},
        },
        asItIs);
    EXPECT_EQ(messageOfScene("[" + std::string(100000, '[')),
              "s.json:1:33: must not be nested deeper than 32 levels");
}

TEST(BrokenScene, TheTopSaysWhatItNeeds)
{
    TRACES("R4");
    expectAll(
        {
            {"[]", "1: / = []: must be an object: { ... }"},
            {"{}", "1: /: the key \"tamias2d\" must be 1, the version of the scene format"},
            {"{\"tamias2d\": 2}", "1: /tamias2d = 2: must be 1, the version of the scene format"},
            {"{\"tamias2d\": 1,\n \"bodeis\": []}", "2: /bodeis = []: unknown key; did you mean \"bodies\"?"},
            {"{\"tamias2d\": 1,\n \"bodies\": {}}", "2: /bodies: must be a list: [ ... ]"},
            {"{\"tamias2d\": 1,\n \"title\": 3}", "2: /title = 3: must be text in quotes"},
            {"{\"tamias2d\": 1,\n \"run\": {\n  \"rate\": 0}}", "3: /run/rate = 0: must be in [1, 1e6] Hz"},
            {"{\"tamias2d\": 1,\n \"run\": {\"substeps\": 4.5}}",
             "2: /run/substeps = 4.5: must be a whole number from -2147483648 to 2147483647"},
            {"{\"tamias2d\": 1, \"view\":\n {\"lower\": [1, 0], \"upper\": [0, 1]}}",
             "1: /view: lower must be left of and below upper"},
            {"{\"tamias2d\": 1, \"world\": {\n \"gravity\": [0]}}",
             "2: /world/gravity = [0]: must be two numbers: [x, y]"},
            {"{\"tamias2d\": 1, \"world\": {\n \"gravity\": [0,\n null]}}",
             "3: /world/gravity/1 = null: must be a number"},
            {"{\"tamias2d\": 1, \"world\": {\n \"lengthUnit\": -1}}",
             "2: /world/lengthUnit = -1: must be in [1e-6, 1e6] m"},
            {"{\"tamias2d\": 1, \"world\": {\n \"frictionMixing\": \"maximun\"}}",
             "2: /world/frictionMixing = \"maximun\": unknown word; did you mean \"maximum\"?"},
            {"{\"tamias2d\": 1, \"world\": {\n \"tuning\": {\n \"calmRate\": 1}}}",
             "3: /world/tuning/calmRate = 1: must be in [0, 1)"},
        },
        asItIs);
}

TEST(BrokenScene, ABodysFaultIsFoundInTheBody)
{
    TRACES("R4", "R2");
    expectAll(
        {
            {"\"position\": [1e10, 0]",
             "3: /bodies/0/position = [10000000000.0,0]: must be finite, each coordinate within +-1e+09 m"},
            {"\"type\": \"dynamik\"",
             "3: /bodies/0/type = \"dynamik\": unknown word; did you mean \"dynamic\"?"},
            {"\"mass\": {\n \"mass\": -1}", "4: /bodies/0/mass/mass = -1: must be finite and > 0 kg"},
            {"\"mass\": {\"mass\": 1,\n \"inertia\": -2}",
             "4: /bodies/0/mass/inertia = -2: must be finite and >= 0 kg*m^2"},
            {"\"linearDamping\": -0.5", "3: /bodies/0/linearDamping = -0.5: must be finite and >= 0 1/s"},
            {"\"angularVelocity\": 2e6",
             "3: /bodies/0/angularVelocity = 2000000.0: must be finite and within +-1e6 rad/s"},
            {"\"userData\": -1",
             "3: /bodies/0/userData = -1: must be a whole number from 0 to 18446744073709551615"},
            {"\"locks\": {\"z\": true}", "3: /bodies/0/locks/z = true: unknown key; known: x, y, rotation"},
            {"\"enabled\": 1", "3: /bodies/0/enabled = 1: must be true or false"},
            {"\"velocity\": [0, 0]",
             "3: /bodies/0/velocity = [0,0]: unknown key; known: name, type, position, angle, "
             "linearVelocity, angularVelocity, mass, linearDamping, angularDamping, "
             "gravityScale, gravity, enabled, allowSleep, awake, userData, locks, shapes, forces, laws"},
            {"\"forces\": [{\"force\": \"up\"}]",
             "3: /bodies/0/forces/0/force = \"up\": must be two numbers: [x, y]"},
            {"\"laws\": [{\"law\": \"wind\"}]", "3: /bodies/0/laws/0/law = \"wind\": no law of this name is "
                                                "built in or was given to the reader; known: "
                                                "springTo, attractionTo, drag, torsionSpring"},
            {"\"laws\": [{\"law\": \"springTo\", \"stiffness\": 1}]",
             "3: /bodies/0/laws/0: must have the key \"point\""},
            {"\"laws\": [{\"law\": \"drag\",\n \"linear\": -1}]",
             "4: /bodies/0/laws/0/linear = -1: must be finite and >= 0 N*s/m"},
        },
        withBody);
}

TEST(BrokenScene, AShapesFaultIsFoundInTheShape)
{
    TRACES("R4", "R3", "DD12");
    expectAll(
        {
            {"", "3: /bodies/0/shapes/0: must have exactly one of circle, capsule, segment, box, polygon, "
                 "regularPolygon"},
            {"\"circle\": {}, \"box\": {}",
             "3: /bodies/0/shapes/0/box: must have exactly one of circle, capsule, "
             "segment, box, polygon, regularPolygon"},
            {"\"cirlce\": {}", "3: /bodies/0/shapes/0/cirlce: unknown key; did you mean \"circle\"?"},
            {"\"circle\": {},\n \"restitution\": 1.1",
             "4: /bodies/0/shapes/0/restitution = 1.1: must be in [0, 1]"},
            {"\"circle\": {},\n \"restitution\": -0.1",
             "4: /bodies/0/shapes/0/restitution = -0.1: must be in [0, 1]"},
            {"\"circle\": {},\n \"friction\": -1",
             "4: /bodies/0/shapes/0/friction = -1: must be in [0, 1e6]"},
            {"\"circle\": {},\n \"filter\": {\n \"group\": 3e9}",
             "5: /bodies/0/shapes/0/filter/group = 3000000000.0: must be a whole number from -2147483648 to "
             "2147483647"},
        },
        withShape);
}

TEST(BrokenScene, GeometryThatTheLibraryRefusesIsToldAtItsPlace)
{
    TRACES("R4");
    // The rule is the library's own; what is tested here is that it arrives, and at the right place.
    const struct {
        const char* text;
        const char* start;
    } table[] = {
        {"\"circle\": {\n \"radius\": 0}", "s.json:4: /bodies/0/shapes/0/circle/radius = 0: must be "},
        {"\"capsule\": {\n \"radius\": -1}", "s.json:4: /bodies/0/shapes/0/capsule/radius = -1: must be "},
        {"\"box\": {\n \"width\": 0}", "s.json:4: /bodies/0/shapes/0/box/width = 0: must be "},
        {"\"regularPolygon\": {\n \"count\": 2}",
         "s.json:4: /bodies/0/shapes/0/regularPolygon/count = 2: must be "},
        {"\"polygon\": {\"radius\": 0,\n \"vertices\": [[0, 0], [1, 0]]}",
         "s.json:4: /bodies/0/shapes/0/polygon/vertices"},
        {"\"polygon\": {\n \"vertices\": [[0, 0], [1, 1], [2, 2]]}",
         "s.json:4: /bodies/0/shapes/0/polygon/vertices"},
        {"\"polygon\": {}", "s.json:3: /bodies/0/shapes/0/polygon: must have the key \"vertices\""},
        {"\"circle\": {},\n \"density\": -1", "s.json:4: /bodies/0/shapes/0/density = -1: must be "},
    };
    for (const auto& [text, start] : table) {
        const std::string message = messageOfScene(withShape(text));
        EXPECT_TRUE(message.starts_with(start)) << text << "\n  " << message;
    }
}

TEST(BrokenScene, ABuiltinsParametersAreTold)
{
    TRACES("R4");
    const auto wrap = [](const std::string& text) {
        return "{\"tamias2d\": 1,\n \"builtin\": {" + text + "}}";
    };
    expectAll(
        {
            {"\"base\": 3", "2: /builtin: must have the key \"name\""},
            {"\"name\": \"pyramit\"",
             "2: /builtin/name = \"pyramit\": no built-in scene has this name; did you mean \"pyramid\"?"},
            {"\"name\": \"pyramid\",\n \"base\": 0",
             "3: /builtin/base = 0: must be a whole number in [1, 150]"},
            {"\"name\": \"pyramid\",\n \"base\": \"20\"",
             "3: /builtin/base = \"20\": must be a whole number in [1, 150]"},
            {"\"name\": \"pyramid\", \"basis\": 3",
             "2: /builtin/basis = 3: no parameter of \"pyramid\" has this name; did you mean \"base\"?"},
            {"\"name\": \"tiles\", \"wall\": 1", "2: /builtin/wall = 1: must be true or false"},
        },
        wrap);
}

TEST(BrokenScene, TheErrorCarriesItsParts)
{
    TRACES("R4");
    try {
        readScene(withShape("\"circle\": {},\n \"restitution\": 1.1"), "s.json");
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_EQ(error.field, "/bodies/0/shapes/0/restitution");
        EXPECT_EQ(error.value, "1.1");
        EXPECT_EQ(error.rule, "must be in [0, 1]");
        const auto* scene = dynamic_cast<const SceneError*>(&error);
        ASSERT_NE(scene, nullptr);
        EXPECT_EQ(scene->source, "s.json");
        EXPECT_EQ(scene->line, 4);
        EXPECT_EQ(scene->column, 2);
    }
}

TEST(BrokenScene, FilesThatCannotBeReadAreTold)
{
    TRACES("R4");
    const auto messageOfOpening = [](const char* name) {
        try {
            openScene(name);
        } catch (const SceneError& error) {
            return std::string(error.what());
        }
        return std::string("(no error)");
    };
    EXPECT_EQ(messageOfOpening("/"), "/: cannot be read, or is empty");
    EXPECT_EQ(messageOfOpening("pyramyd:base=3"),
              "pyramyd:base=3: is neither a file nor a built-in scene; did you mean \"pyramid\"?");
}

TEST(BrokenScene, AnyDamageIsAnErrorOrAnotherSceneAndNothingWorse)
{
    TRACES("R4", "ADR12");
    const std::string good =
        R"({"tamias2d": 1, "title": "t\u00e4", "run": {"rate": 60}, "view": {"lower": [0, 0], "upper": [1, 1]},
        "builtin": {"name": "stack", "boxes": 2}, "world": {"gravity": [0, -9.81], "tuning": {"restGap": 0.001}},
        "bodies": [{"name": "b", "type": "dynamic", "position": [0, 9], "mass": {"mass": 1}, "gravity": null,
        "forces": [{"force": [1, 2]}], "laws": [{"law": "drag", "linear": 1}], "shapes": [
        {"polygon": {"vertices": [[0, 0], [1, 0], [0, 1]]}, "filter": {"mask": 18446744073709551615}},
        {"capsule": {"a": [0, 0], "b": [1, 0]}, "frictionMixing": "maximum"}, {"regularPolygon": {"count": 5}}]}],
        "laws": [{"law": "springTo", "point": [0, 0], "stiffness": 1, "body": 0}]})";
    ASSERT_EQ(messageOfScene(good), "(no error)");

    // One to three bytes replaced, removed or doubled, by numbers that are the same everywhere (MINSTD).
    std::uint32_t state = 1;
    const auto next = [&](std::size_t below) {
        state = static_cast<std::uint32_t>(std::uint64_t{state} * 48271 % 2147483647);
        return static_cast<std::size_t>(state) % below;
    };
    constexpr char kBytes[] = "{}[]\",:.-+eE0123456789\\ tnu/\xff\x01";
    int errors = 0;
    for (int i = 0; i < 4000; ++i) {
        std::string text = good;
        for (std::size_t damage = 1 + next(3); damage > 0; --damage) {
            const std::size_t at = next(text.size());
            switch (next(3)) {
            case 0:
                text[at] = kBytes[next(sizeof kBytes - 1)];
                break;
            case 1:
                text.erase(at, 1 + next(8));
                break;
            default:
                text.insert(at, text.substr(at, 1 + next(8)));
                break;
            }
        }
        errors += messageOfScene(text) == "(no error)" ? 0 : 1;  // anything but a SceneError ends the test
    }
    EXPECT_GT(errors, 3000);
    EXPECT_LT(errors, 4000);
}

TEST(BrokenScene, ANumberTooLargeForFloatIsRefusedInFloatOnly)
{
    TRACES("R4", "ADR2");
    const std::string text = "{\"tamias2d\": 1, \"world\": {\"gravity\": [0, 1e39]}}";
    EXPECT_EQ(messageOfScene(text),
              kDouble ? "(no error)"
                      : "s.json:1: /world/gravity/1 = 1e+39: must be finite in single precision, "
                        "that is within 3.4e38 of zero");
}

}  // namespace
}  // namespace tamias2d::test
