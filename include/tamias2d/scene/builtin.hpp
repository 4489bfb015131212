// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/scene/scene.hpp>

#include <cstdint>
#include <string_view>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

enum class BuiltinParameterType : std::uint8_t { Integer, Number, Choice, Switch };

/// One parameter of a built-in scene.
struct BuiltinParameter {
    std::string name;
    BuiltinParameterType type = BuiltinParameterType::Number;
    std::string standard;              ///< its default, as it would be typed; "auto": see `doc`
    double least = 0, most = 0;        ///< of an Integer or a Number
    std::vector<std::string> choices;  ///< of a Choice
    std::string doc;                   ///< one line, with the unit
};

/// A scene made by code, for any values of its parameters.
struct BuiltinScene {
    std::string name;
    std::string title;
    std::string doc;  ///< one line
    std::vector<BuiltinParameter> parameters;
};

/// All built-in scenes, sorted by name.
const std::vector<BuiltinScene>& builtinScenes();

/// Makes a built-in scene from its name and parameters: "pyramid", "pyramid:base=20",
/// "stack:boxes=20,offset=0.05,seed=3". What is not given has its default.
/// @throws SceneError naming the scene or the parameter, the value and the rule
Scene makeBuiltinScene(std::string_view specification);

}  // namespace tamias2d::inline TAMIAS_PRECISION
