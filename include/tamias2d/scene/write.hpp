// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/scene/scene.hpp>

#include <string>

namespace tamias2d::inline TAMIAS_PRECISION {

struct SceneWriteOptions {
    bool everything = false;  ///< also what has its default value
};

/// The World as it is now, in the scene format. Read again in the same precision it gives a World
/// with the same definitions, poses and velocities, to the bit.
///
/// Not in a scene: the clock, contacts and their impulses, forces for the next step only. A force
/// law of your own is written by its name; to read it again, give it to the reader.
std::string writeScene(const World& world, const SceneInfo& info = {}, const SceneWriteOptions& options = {});

}  // namespace tamias2d::inline TAMIAS_PRECISION
