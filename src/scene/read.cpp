// SPDX-License-Identifier: MIT
// A scene's text becomes a World from the top down: settings, built-in bodies, bodies, laws. A fault
// anywhere ends it with an error, and the half-made World goes with it.
#include <tamias2d/scene/read.hpp>

#include "scene/builtin/builtins.hpp"
#include "scene/geometry_text.hpp"
#include "scene/joints_text.hpp"
#include "scene/laws_text.hpp"
#include "scene/parse.hpp"
#include "scene/read_values.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace tamias2d::inline TAMIAS_PRECISION {

namespace {

using namespace scene;

/// Calls the library; what it refuses is told at the node whose definition it was given.
template <class Act>
decltype(auto) tryAt(const Node& node, Act act)
{
    try {
        return act();
    } catch (const SceneError&) {
        throw;
    } catch (const InputError& error) {
        node.refuse(error);
    }
}

void readShape(const Node& node, Body body)
{
    ObjectReader in(node);
    ShapeDef def;
    def.geometry = readGeometry(in);
    in.readFields(def);
    in.readFields(def.material);
    in.finish();
    tryAt(node, [&] { body.createShape(def); });
}

void readForce(const Node& node, Body body)
{
    LastingForce force;
    readValue(node, force);
    tryAt(node, [&] { body.addForce(force); });
}

void readBodyLaw(const Node& node, Body body, const SceneReadOptions& options)
{
    ObjectReader in(node);
    ForceLaw law = readLaw(in, options.laws);
    in.finish();
    tryAt(node, [&] { body.addForceLaw(std::move(law)); });
}

BodyId readBody(const Node& node, World& world, const SceneReadOptions& options)
{
    ObjectReader in(node);
    BodyDef def;
    in.readFields(def);
    Locks locks;
    in.read("locks", locks);
    def.lockX = locks.x;
    def.lockY = locks.y;
    def.lockRotation = locks.rotation;

    Body body = tryAt(node, [&] { return world.createBody(def); });
    in.each("shapes", [&](const Node& shape) { readShape(shape, body); });
    in.each("forces", [&](const Node& force) { readForce(force, body); });
    in.each("laws", [&](const Node& law) { readBodyLaw(law, body, options); });
    in.finish();
    return body.id();
}

/// A body named by its place among all bodies, or by its name.
Body findBodyFor(const Node& node, World& world, const std::vector<BodyId>& bodies)
{
    const Json& value = node.value();
    if (value.is_number_unsigned() && value.get<std::uint64_t>() < bodies.size()) {
        return world.body(bodies[value.get<std::size_t>()]);
    }
    if (value.is_string()) {
        if (const auto found = world.findBody(value.get<std::string>())) return *found;
    }
    node.refuse("must be the name of a body or its place in the list, from 0");
}

void readWorldLaw(const Node& node, World& world, const std::vector<BodyId>& bodies,
                  const SceneReadOptions& options)
{
    ObjectReader in(node);
    ForceLaw law = readLaw(in, options.laws);
    const std::optional<Node> body = in.find("body");
    in.finish();
    tryAt(node, [&] {
        if (body)
            findBodyFor(*body, world, bodies).addForceLaw(std::move(law));
        else
            world.addForceLaw(std::move(law));
    });
}

void readJointOf(const Node& node, World& world, const std::vector<BodyId>& bodies)
{
    ObjectReader in(node);
    const auto body = [&](const char* key) {
        const std::optional<Node> child = in.find(key);
        if (!child) node.refuse(std::string("must have the key \"") + key + "\"");
        return findBodyFor(*child, world, bodies).id();
    };
    const BodyId bodyA = body("bodyA"), bodyB = body("bodyB");
    JointText joint = readJoint(in);
    in.finish();
    joint.def.bodyA = bodyA;
    joint.def.bodyB = bodyB;
    try {
        world.createJoint(joint.def);
    } catch (const InputError& error) {
        const bool ofKind = error.field.find("Joint.") != std::string::npos;
        if (ofKind) node.child(joint.kind).refuse(error);
        node.refuse(error);
    }
}

void readRun(const Node& node, SceneInfo& info)
{
    readValue(node, info);
    const auto check = [&](const char* key, double value, double least, double most, const char* rule) {
        if (!(value >= least && value <= most)) node.child(key).refuse(rule);
    };
    check("seconds", info.seconds, 0, 1e9, "must be in [0, 1e9] s");
    check("rate", info.rate, 1, 1e6, "must be in [1, 1e6] Hz");
    check("substeps", info.substeps, 1, 256, "must be in [1, 256]");
}

void readView(const Node& node, std::optional<Aabb>& view)
{
    Aabb box;
    readValue(node, box);
    if (!(box.lower.x < box.upper.x && box.lower.y < box.upper.y)) {
        node.refuse("lower must be left of and below upper");
    }
    view = box;
}

void checkVersion(ObjectReader& in)
{
    const std::optional<Node> version = in.find("tamias2d");
    const std::string rule = "must be " + std::to_string(kSceneVersion) + ", the version of the scene format";
    if (!version) in.node().refuse("the key \"tamias2d\" " + rule);
    if (version->value() != kSceneVersion) version->refuse(rule);
}

Scene readDocument(const Node& top, const SceneReadOptions& options)
{
    ObjectReader in(top);
    in.find("$schema");  // for editors, which then know the keys
    checkVersion(in);
    Scene scene;

    // A built-in scene says first what the world is like and how to run it; the text overrules it.
    WorldDef def;
    std::optional<BuiltinChoice> builtin;
    if (const auto node = in.find("builtin")) {
        builtin = readBuiltin(*node);
        def = builtin->worldDef(scene.info);
    }
    in.read("title", scene.info.title);
    in.read("description", scene.info.description);
    if (const auto node = in.find("run")) readRun(*node, scene.info);
    if (const auto node = in.find("view")) readView(*node, scene.info.view);
    const auto settings = in.find("world");
    if (settings) readValue(*settings, def);
    scene.world = tryAt(settings.value_or(top), [&] { return std::make_unique<World>(def); });

    if (builtin) tryAt(top.child("builtin"), [&] { builtin->build(*scene.world); });
    std::vector<BodyId> bodies = scene.world->bodies();
    in.each("bodies", [&](const Node& body) { bodies.push_back(readBody(body, *scene.world, options)); });
    in.each("joints", [&](const Node& joint) { readJointOf(joint, *scene.world, bodies); });
    in.each("laws", [&](const Node& law) { readWorldLaw(law, *scene.world, bodies, options); });
    in.finish();
    return scene;
}

}  // namespace

Scene readScene(std::string_view text, std::string_view source, const SceneReadOptions& options)
{
    const Json root = parseJson(text, source);
    const Document document{text, source};
    return readDocument(Node(document, root), options);
}

Scene loadSceneFile(const std::string& path, const SceneReadOptions& options)
{
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    // A folder opens like a file and fails on the first read only.
    if (!file || file.peek() == std::ifstream::traits_type::eof() || !(text << file.rdbuf())) {
        throw SceneError(path, 0, 0, "", "", "cannot be read, or is empty");
    }
    return readScene(text.str(), path, options);
}

Scene openScene(const std::string& name, const SceneReadOptions& options)
{
    std::error_code ignored;
    const std::string builtin = name.substr(0, name.find(':'));
    const auto& known = builtinScenes();
    const bool isBuiltin =
        std::any_of(known.begin(), known.end(), [&](const BuiltinScene& s) { return s.name == builtin; });
    if (std::filesystem::exists(name, ignored)) return loadSceneFile(name, options);
    if (isBuiltin) return makeBuiltinScene(name);

    std::vector<std::string> names;
    for (const BuiltinScene& s : known) names.push_back(s.name);
    throw SceneError(name, 0, 0, "", "",
                     "is neither a file nor a built-in scene" + suggestion(builtin, names));
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
