// SPDX-License-Identifier: MIT
#pragma once

#include "islands/links.hpp"
#include "math/lane.hpp"
#include "model/contacts.hpp"
#include "model/motion.hpp"
#include "model/step_context.hpp"

#include <tamias2d/math/vec2.hpp>

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

using Wide = Lane<kLanes>;
using WideVec2 = BasicVec2<Wide>;

/// One point of several contacts. The names are those of ContactPointRow.
struct WidePoint {
    WideVec2 armA, armB;
    Wide allowed;            // speed at which it may still close   [m/s]
    Wide normalMass, tangentMass;
    Wide normalImpulse, tangentImpulse;
};

/// Contacts of one color, side by side: no two of them share a body that moves. All have one point, or all
/// two. Lanes beyond `lanes` repeat the first and are never written back.
struct ContactBlock {
    std::uint32_t contact[kLanes], rowA[kLanes], rowB[kLanes], island[kLanes];
    bool movesA[kLanes] = {}, movesB[kLanes] = {};   // false beyond `lanes`
    int lanes = 0, count = 0;
    WideVec2 normal;
    Wide friction, surfaceSpeed, crossMass;
    WideVec2 invMassA, invMassB;
    Wide invInertiaA, invInertiaB;
    WidePoint points[2];
};

/// The contacts of a tick as the passes go over them: color by color, plain ones in blocks, then the others.
/// The memory is kept.
struct ContactBlocks {
    struct Color {
        std::uint32_t blocksEnd, singlesEnd;
    };
    std::vector<Color> colors;
    std::vector<ContactBlock> blocks;
    std::vector<std::uint32_t> singles;        // contacts
    std::vector<LaneRow> velocities;           // by row: of the center, and spin
};

/// Sorts the contacts into blocks. A contact is plain if the tick has no impact of it, nothing of it is left
/// to impacts, and neither rolling resistance nor a body that cannot give way makes it a case of its own.
void gatherBlocks(const ContactTable& contacts, const MotionTable& motions, const Islands& islands,
                  const StepContext& context, ContactBlocks& blocks);

/// One pass over all contacts in the islands of which `before` is above `restless`; over all if `before` is
/// empty. Raises `unrest` by island to the greatest change of normal speed.   [m/s]
void passOver(ContactBlocks& blocks, ContactTable& contacts, MotionTable& motions, const Islands& islands,
              const StepContext& context, real restless, const std::vector<real>& before,
              std::vector<real>& unrest);

/// Writes impulses back to the contacts, adds them to the sums of the step, and writes velocities to the
/// bodies.
void scatterBlocks(const ContactBlocks& blocks, ContactTable& contacts, MotionTable& motions);

/// The island of either body.
inline std::uint32_t islandOf(const Islands& islands, std::uint32_t rowA, std::uint32_t rowB)
{
    const std::uint32_t island = islands.islandOf[rowA];
    return island != Islands::kNone ? island : islands.islandOf[rowB];
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
