// SPDX-License-Identifier: MIT
// Joints in a scene: the kind is a key, like that of a shape's geometry.
#pragma once

#include "scene/read_values.hpp"
#include "scene/write_values.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

/// What a joint of a scene is given beside its bodies, and the key its kind has.
struct JointText {
    JointDef def;
    std::string kind;
};

/// Reads all keys of a joint but "bodyA" and "bodyB".
JointText readJoint(ObjectReader& in);

/// Writes them.
OrderedJson jointJson(const JointDef& def, bool everything);

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
