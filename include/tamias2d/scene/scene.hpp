// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/error.hpp>
#include <tamias2d/geometry/aabb.hpp>
#include <tamias2d/world/world.hpp>

#include <memory>
#include <optional>
#include <string>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What a scene says about itself besides its World: all of it may be overruled by who runs it.
struct SceneInfo {
    std::string title;
    std::string description;
    double seconds = 10;       ///< how long it is worth watching    [s]    in [0, 1e9]
    double rate = 60;          ///< steps per second                 [Hz]   in [1, 1e6]
    int substeps = 4;          ///< of each step                     [1]    in [1, 256]
    std::optional<Aabb> view;  ///< what to look at; none: fit it    [m]    lower < upper
};

/// A World and what its author says about it.
struct Scene {
    SceneInfo info;
    std::unique_ptr<World> world;  ///< never null
};

/// What is wrong with a scene's text, and where. No World has been made when it is thrown.
///
/// `what()` reads "scenes/x.json:12: /bodies/3/shapes/0/restitution = 1.1: must be in [0, 1]";
/// `field` is the path (a JSON pointer), `value` the JSON given there (empty for a whole object).
class SceneError : public InputError {
public:
    SceneError(std::string sourceName, int lineNumber, int columnNumber, std::string path,
               std::string givenValue, std::string brokenRule);

    std::string source;  ///< as given to the reader, e.g. the file's name
    int line = 0;        ///< from 1; 0: not about a place in the text
    int column = 0;      ///< from 1, in bytes; 0: not known

    const char* what() const noexcept override { return sceneText_.c_str(); }

private:
    std::string sceneText_;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
