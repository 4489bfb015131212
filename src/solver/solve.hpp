// SPDX-License-Identifier: MIT
#pragma once

#include "base/lane_choice.hpp"
#include "base/timer.hpp"
#include "contacts/rows.hpp"
#include "forces/accelerations.hpp"
#include "islands/links.hpp"
#include "joints/tick.hpp"
#include "solver/body_kernels.hpp"
#include "solver/calm.hpp"
#include "solver/contact_passes.hpp"
#include "solver/hinge_lanes.hpp"
#include "solver/impacts.hpp"
#include "solver/quiet_bodies.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// What the solver works with; it keeps its memory from step to step.
struct SolverScratch {
    CalmRows calmRows;
    std::vector<std::pair<Vec2, real>> held;   // by row: velocity and spin
    TickRows rows;
    Table<LaneRow> before;               // by row: velocities before the passes
    std::vector<TickEnergy> energies;    // by island
    std::vector<std::uint32_t> forgotten;  // contacts of groups that begin a tick anew
    ContactPasses passes;
    ImpactScratch impacts;
    VisitedBodies visited;
    QuietScratch quiet;

    SolverScratch(LaneWidth lanes, Parallel& parallel)
        : passes(parallel), impacts(lanes), parallel_(parallel), asked_(askedLanes(lanes))
    {
    }

    /// Before each step: the width for the most rows there have been. Lanes of another width would need
    /// memory of their own, and a warm world asks for none.
    void suit(std::size_t count, ContactTable& contacts);
    const BodyKernels& bodies() const { return *bodyKernelsOfStep_; }
    /// Before that: those for so many rows.
    const BodyKernels& bodiesFor(std::size_t count) const
    {
        return bodyKernels(suitedLanes(asked_, maximum(most_, count)));
    }
    HingeLanes& hinges() { return *hinges_; }

private:
    Parallel& parallel_;
    LaneWidth asked_;
    LaneWidth width_ = LaneWidth::Best;   // of the hinges
    std::unique_ptr<HingeLanes> hinges_;
    std::size_t most_ = 0;  // rows, ever
    const BodyKernels* bodyKernelsOfStep_ = nullptr;
};

/// What the solver reads and moves.
struct SolverStage {
    const ContactWorld& world;
    const ForceField& field;
    const RestTrees& resting;
    const SleepTable& asleep;
    Islands& islands;
    MotionTable& motions;
    ContactTable& contacts;
    JointTable& joints;
    JointSystem& system;                  ///< the joints at work, measured where the bodies are
    Table<SweepBox>& boxes;
    std::vector<ImpactRecord>& impacts;   ///< filled
    std::vector<std::uint32_t>& roused;   ///< filled: sleeping groups that woke in mid-step
    bool sameContacts;                    ///< are they, one by one, those at the end of the last step?
    bool sameIslands;                     ///< are the islands those of the last step?
    const std::vector<std::uint8_t>& renewed;   ///< by contact: has it another manifold than then?
    SolverScratch& scratch;
    Profile& profile;
    Parallel& parallel;
};

/// What the solver counted and how long its parts took.
struct SolverCounts {
    ClampCounts clamps;
    std::uint32_t repaired = 0;
    std::uint32_t lawFaults = 0;
    std::uint32_t quiet = 0;           ///< bodies that made the step in one tick
    std::uint32_t piles = 0;           ///< solved at once
    std::uint32_t pileFallbacks = 0;   ///< visits to such a pile that found no solution
    double impactTime = 0, solveTime = 0;   ///< [ms]
};

/// The step in one tick, for those that have been found to be quiet: no impact is near. After it the ticks
/// are for all others. In quiet_tick.cpp; docs/theory/calm.md, section 6.
void tickQuiet(SolverStage& stage, const StepContext& context, ClampCounts& clamps);

/// All passes of a tick. Where a group solved at once is pulled straight, next to nothing holds its rows
/// apart, and it may be thrown farther than any speed at hand can tell; where loops tie it, the passes may
/// make energy. Then they are done again: if it can be projected it will be, by settleLost; else it is
/// visited joint by joint, softly, from here on, and begins without what its joints and contacts carry. In
/// thrown_groups.cpp; docs/theory/joints.md, section 9.
void passOver(SolverStage& stage, const JointWorld& world);

/// Moves all rows through the step: the only loop over ticks. docs/theory/contacts.md, section 5.
SolverCounts solve(SolverStage& stage, const StepContext& context);

}  // namespace tamias2d::inline TAMIAS_PRECISION
