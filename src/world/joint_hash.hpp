// SPDX-License-Identifier: MIT
// Joints in the hash of a world.
#pragma once

#include "base/hash.hpp"
#include "model/bodies.hpp"
#include "model/joints.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// What it is, and what it carries.
void add(Hasher& hash, const JointRow& j);

/// And what a constraint of one's own asks for now.
void addRows(Hasher& hash, const JointRow& j, const BodyTable& bodies);

}  // namespace tamias2d::inline TAMIAS_PRECISION
