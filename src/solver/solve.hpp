// SPDX-License-Identifier: MIT
#pragma once

#include "forces/accelerations.hpp"
#include "islands/links.hpp"
#include "solver/impacts.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// What the solver reads and moves.
struct SolverStage {
    const ContactWorld& world;
    const ForceField& field;
    const Islands& islands;
    MotionTable& motions;
    ContactTable& contacts;
    std::vector<SweepBox>& boxes;
    std::vector<ImpactRecord>& impacts;   ///< filled
};

/// What the solver counted and how long its parts took.
struct SolverCounts {
    ClampCounts clamps;
    std::uint32_t repaired = 0;
    std::uint32_t lawFaults = 0;
    double impactTime = 0, solveTime = 0;   ///< [ms]
};

/// Moves all rows through the step: the only loop over ticks. docs/theory/contacts.md, section 5.
SolverCounts solve(SolverStage& stage, const StepContext& context);

}  // namespace tamias2d::inline TAMIAS_PRECISION
