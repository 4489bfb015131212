// SPDX-License-Identifier: MIT
#pragma once

#include "contacts/update.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// How far the centers of two bodies may move against each other before their manifold is found anew, and how
/// far turning may take the points of each.   [rest gaps]
inline constexpr real kManifoldRoom = real(0.25);

/// What the manifolds of some contacts came to.
struct ManifoldCounts {
    std::uint32_t kept = 0;  ///< manifolds of the step before
    std::uint32_t swept = 0;  ///< pairs that are looked at again in every tick
    std::uint32_t exhausted = 0;  ///< searches for a time of impact that ran out of iterations
};

/// What looking for manifolds works with; it keeps its memory from step to step.
struct ManifoldScratch {
    std::vector<std::uint8_t> needed;  // by row: is its way asked for?
    std::vector<ManifoldCounts> counts;  // by chunk
    std::vector<std::uint8_t> renewed;  // by contact: has it another manifold than in the step before?
};

/// Which contacts have no manifold for the step, in scratch.renewed: a contact keeps the one it has while its
/// bodies hardly turn, nor move against each other. The facts of contacts are those of the end of the last
/// step if `same`, and are found anew if not.
void findRenewed(ContactTable& contacts, bool same, const MotionTable& motions, const StepContext& context,
                 ManifoldScratch& scratch, Parallel& parallel);

/// Then: their manifolds for the whole step, from 0 to dt, which `paths` must be for, placed where the bodies
/// are. Pairs that may still meet in another way are flagged `swept`: they are looked at again in every tick.
ManifoldCounts renewManifolds(ContactTable& contacts, const ShapeTable& shapes, const MotionTable& motions,
                              const StepContext& context, ExpectedPaths& paths, ManifoldScratch& scratch,
                              Parallel& parallel);

/// Does some point of the contact count as touching, with the gaps that were found last?
bool isTouching(const Contact& contact, const Tuning& tuning);
Nearness nearnessOf(const Contact& contact, const Tuning& tuning);

/// What is to be known of a contact beside all that it holds: notes the facts and the nearness of a row.
void noteFacts(ContactTable& contacts, std::size_t row, const Tuning& tuning);

}  // namespace tamias2d::inline TAMIAS_PRECISION
