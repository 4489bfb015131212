// SPDX-License-Identifier: MIT
#pragma once

#include "broadphase/sweep.hpp"
#include "model/bodies.hpp"
#include "model/contacts.hpp"
#include "model/motion.hpp"
#include "model/shapes.hpp"

#include <functional>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What the contacts need to know of the world they are in.
struct ContactWorld {
    const BodyTable& bodies;
    const ShapeTable& shapes;
    const MotionTable& motions;
    MixingRule frictionRule, restitutionRule;
    real restGap;   ///< over the smaller width   [1]
};

/// May these two shapes push each other?
bool mayCollide(const ContactWorld& world, const ShapePair& pair);

/// A contact of the pair as it is before any manifold: materials mixed, rows looked up.
Contact makeContact(const ContactWorld& world, const ShapePair& pair);

/// Brings the contacts in line with the sorted pairs: old ones keep all they carry, new ones start
/// empty, those without a pair leave; `onLeave` hears of each that leaves.
void matchPairs(const ContactWorld& world, const std::vector<ShapePair>& pairs,
                std::vector<Contact>& contacts, const std::function<void(const Contact&)>& onLeave);

}  // namespace tamias2d::inline TAMIAS_PRECISION
