// SPDX-License-Identifier: MIT
// Scenes made by code: what each is called and asks for, and how its parameters get their values.
#pragma once

#include <tamias2d/scene/builtin.hpp>

#include "scene/node.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

/// What the parameters of one built-in scene are set to.
class Parameters {
public:
    explicit Parameters(const BuiltinScene& about) : about_(&about) {}

    /// The parameter of that name, or null.
    const BuiltinParameter* find(std::string_view name) const noexcept;

    /// Sets a known parameter from text. Returns the broken rule, or nothing if all is well.
    std::optional<std::string> set(const BuiltinParameter& parameter, const std::string& text);

    int integer(std::string_view name) const;
    real number(std::string_view name) const;
    std::string choice(std::string_view name) const;
    bool isOn(std::string_view name) const;
    /// A number whose default is worked out by the scene.
    std::optional<real> numberIfGiven(std::string_view name) const;

private:
    const std::string& text(std::string_view name) const;

    const BuiltinScene* about_;
    std::map<std::string, std::string, std::less<>> given_;
};

/// One built-in scene.
struct Builtin {
    BuiltinScene about;
    /// The world it is made for, and how to run and watch it.
    void (*prepare)(const Parameters&, WorldDef&, SceneInfo&) = nullptr;
    /// Makes its bodies in a world that a scene file may have set up otherwise.
    void (*build)(const Parameters&, World&) = nullptr;
};

/// A built-in scene with its parameters set.
struct BuiltinChoice {
    const Builtin* builtin;
    Parameters parameters;

    WorldDef worldDef(SceneInfo& info) const;
    void build(World& world) const { builtin->build(parameters, world); }
};

/// Reads {"name": "pyramid", "base": 20}.
BuiltinChoice readBuiltin(const Node& node);

/// All of them, sorted by name.
const std::vector<Builtin>& allBuiltins();

Builtin bounceScene();
Builtin cradleScene();
Builtin dominoesScene();
Builtin gasScene();
Builtin inclineScene();
Builtin orbitScene();
Builtin pendulumsScene();
Builtin pileScene();
Builtin pyramidScene();
Builtin stackScene();
Builtin tilesScene();
Builtin wreckerScene();

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
