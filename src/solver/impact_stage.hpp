// SPDX-License-Identifier: MIT
#pragma once

#include "contacts/pairs.hpp"
#include "model/contacts.hpp"
#include "model/step_context.hpp"
#include "solver/impact_scratch.hpp"
#include "solver/integrate.hpp"

#include <tamias2d/model/clamps.hpp>
#include <tamias2d/model/events.hpp>

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// One impulse at its time, with slots instead of ids.
struct ImpactRecord {
    std::uint32_t shapeA, shapeB;   // slots
    std::uint32_t number;           // in the order in which they acted
    HitEvent hit;                   // all but its ids
};

/// What the impact stage works on and fills.
struct ImpactStage {
    const ContactWorld& world;
    MotionTable& motions;
    ContactTable& contacts;
    std::vector<SweepBox>& boxes;          // of the broad phase: grown for bodies thrown out of theirs
    std::vector<ImpactKick>& kicks;        // by row
    std::vector<ImpactRecord>& records;
    ImpactScratch& scratch;
    ClampCounts& clamps;
    std::uint32_t& repaired;               // pairs added in mid-step
    std::uint32_t& groups;                 // impacts so far in the step
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
