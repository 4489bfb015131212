// SPDX-License-Identifier: MIT
// JSON text into values, with every fault of the text told by line and column.
#pragma once

#include <tamias2d/scene/scene.hpp>

#include <nlohmann/json.hpp>

#include <string_view>

namespace tamias2d::inline TAMIAS_PRECISION::scene {

/// Deeper than any scene, shallow enough for code that walks values by calling itself.
inline constexpr int kMaxDepth = 32;

/// @throws SceneError if the text is not JSON, has a key twice in an object, is nested deeper than
/// kMaxDepth or holds a number no double can hold
nlohmann::json parseJson(std::string_view text, std::string_view source);

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
