// SPDX-License-Identifier: MIT
#pragma once

#include "broadphase/rest_trees.hpp"
#include "contacts/pairs.hpp"
#include "forces/accelerations.hpp"
#include "islands/links.hpp"
#include "joints/tick.hpp"
#include "model/contacts.hpp"
#include "model/sleep.hpp"
#include "model/step_context.hpp"
#include "solver/body_kernels.hpp"
#include "solver/contact_passes.hpp"
#include "solver/hinge_lanes.hpp"
#include "solver/impact_scratch.hpp"
#include "solver/visited_bodies.hpp"

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
    const ForceField& field;
    const RestTrees& resting;              // what holds still
    const SleepTable& asleep;
    Islands& islands;
    MotionTable& motions;
    ContactTable& contacts;
    ContactPasses& passes;
    const BodyKernels& kernels;
    TickRows& rows;
    JointTable& joints;
    JointSystem& system;
    HingeLanes& hinges;
    Table<SweepBox>& boxes;          // of the broad phase: grown for bodies thrown out of theirs
    std::vector<ImpactRecord>& records;
    ImpactScratch& scratch;
    ClampCounts& clamps;
    std::uint32_t& repaired;               // pairs added in mid-step
    std::uint32_t& groups;                 // impacts so far in the step
    std::uint32_t& lawFaults;
    std::vector<std::uint32_t>& roused;    // sleeping groups that impacts of the step have woken
    VisitedBodies& visited;
    Parallel& parallel;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
