// SPDX-License-Identifier: MIT
#pragma once

#include "islands/links.hpp"
#include "model/motion.hpp"
#include "model/step_context.hpp"
#include "solver/body_kernels.hpp"
#include "solver/tick_rows.hpp"
#include "tasks/parallel.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A rigid motion, and how it changed in the tick.
struct CalmReference {
    Position center;
    Vec2 velocity, change;
    real spin = 0, spinChange = 0;
};

/// Mass, motion and what calming took away of an island that stands on nothing.
struct FreeIsland {
    double mass = 0, inertia = 0;
    DVec2 weighted;              // sum of m x, from the island's first body
    Position first;
    bool bears = false;          // does a body of it carry a load?
    bool started = false;
    DVec2 momentum, momentumChange;
    double turning = 0, turningChange = 0;   // angular momentum about the center, and its change
    CalmReference motion;
    DVec2 lost;                  // momentum
    double lostSpin = 0;         // angular momentum about the center
};

/// A body, by its row, and its island among those that stand on nothing.
struct FloatingRow {
    std::uint32_t row, island;
};

/// The bodies that calming may concern, of a step: those of islands of more than one body, with one motion to
/// come to rest against.
struct CalmRows {
    std::vector<CalmPair> grounded;  // those whose island stands on one ground
    std::vector<FloatingRow> floating;  // those whose island stands on nothing
    std::vector<FreeIsland> islands;  // that stand on nothing
    std::vector<std::uint32_t> numberOf;  // by island: which of those it is
    std::vector<CalmPair> chosenGrounded;  // those that the tick is for
    std::vector<FloatingRow> chosenFloating;
};
void findCalmRows(const Islands& islands, CalmRows& found);

/// Chooses those of them whose bodies are `quiet`, by row, or all others.
void chooseCalmRows(const std::vector<std::uint8_t>& quiet, bool isQuiet, CalmRows& calmRows);

/// Slows loaded bodies that are already slow and not speeding up: against their grounds, or, where their
/// island stands on nothing, against the island's own motion, whose momentum is kept. docs/theory/calm.md.
void calm(Table<Motion>& rows, TickRows& lanes, CalmRows& calmRows, const BodyKernels& kernels,
          const StepContext& context, Parallel& parallel);

}  // namespace tamias2d::inline TAMIAS_PRECISION
