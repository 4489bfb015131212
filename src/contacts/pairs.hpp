// SPDX-License-Identifier: MIT
#pragma once

#include "broadphase/sweep.hpp"
#include "model/bodies.hpp"
#include "model/contacts.hpp"
#include "model/joints.hpp"
#include "model/motion.hpp"
#include "model/shapes.hpp"
#include "tasks/parallel.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// What the contacts need to know of the world they are in.
struct ContactWorld {
    const BodyTable& bodies;
    const ShapeTable& shapes;
    const MotionTable& motions;
    MixingRule frictionRule, restitutionRule;
    real restGap;   ///< over the smaller width   [1]
    const UncoupledPairs& uncoupled;   ///< bodies that a joint keeps from colliding
};

/// May these two shapes push each other?
bool mayCollide(const ContactWorld& world, const ShapePair& pair);

/// A contact of the pair as it is before any manifold: materials mixed, rows looked up.
Contact makeContact(const ContactWorld& world, const ShapePair& pair);

/// What matching works with; it keeps its memory from step to step.
struct MatchScratch {
    Table<Contact> matched;
    Table<Contact> left;    // contacts that touched and have no pair any more, in their order
    std::vector<std::uint8_t> allowed;      // by pair: may the two collide?
    std::vector<std::uint8_t> leaves;       // by old contact: does it belong into that list?
    std::vector<std::uint32_t> starts;      // by chunk of pairs: where its contacts begin
    std::vector<std::pair<ShapePair, std::uint32_t>>
        late;   // contacts that are out of order, and where they are
};

/// Brings the contacts in line with the sorted pairs: old ones keep all they carry, new ones start
/// empty, those without a pair leave; those of them that touched stand in `scratch.left`.
void matchPairs(const ContactWorld& world, const std::vector<ShapePair>& pairs, Table<Contact>& contacts,
                MatchScratch& scratch, Parallel& parallel);

/// Sorts contacts by their pairs, of which all but some at the end are sorted already.
void sortContacts(Table<Contact>& contacts, MatchScratch& scratch);

}  // namespace tamias2d::inline TAMIAS_PRECISION
