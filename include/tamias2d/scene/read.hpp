// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/forces/force_law.hpp>
#include <tamias2d/scene/scene.hpp>

#include <string_view>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What a reader may be given besides the text.
struct SceneReadOptions {
    /// Force laws of your own. A scene names them only: {"law": "wind"} takes the one called "wind".
    std::vector<ForceLaw> laws;
};

/// Makes a Scene from text in the scene format (docs/guide/scenes.md, docs/scene.schema.json).
/// @param source  what to call the text in messages, e.g. its file name
/// @throws SceneError with line, path, value and rule
Scene readScene(std::string_view text, std::string_view source = "scene",
                const SceneReadOptions& options = {});

/// Reads a scene file.
/// @throws SceneError as readScene, or if the file cannot be read
Scene loadSceneFile(const std::string& path, const SceneReadOptions& options = {});

/// Opens whatever `name` means: a file of that path, else a built-in scene with its parameters
/// ("pyramid:base=20"; see makeBuiltinScene).
/// @throws SceneError if it is neither, or has a fault
Scene openScene(const std::string& name, const SceneReadOptions& options = {});

}  // namespace tamias2d::inline TAMIAS_PRECISION
