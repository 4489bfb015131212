// SPDX-License-Identifier: MIT
#pragma once

#include "model/bodies.hpp"
#include "model/contacts.hpp"
#include "model/motion.hpp"
#include "model/shapes.hpp"
#include "model/step_context.hpp"
#include "solver/solve.hpp"
#include "tasks/chunk_lists.hpp"
#include "tasks/parallel.hpp"

#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

struct FinalCounts {
    std::uint32_t nonFinite = 0;   // bodies set aside
    std::uint32_t stopped = 0;     // at the edge of the world
    std::uint32_t touching = 0;    // contacts
    double deepestOverlap = 0;     // [m]
};

struct FinalScratch {
    std::vector<FinalCounts> ofChunks;
    ChunkLists<std::uint32_t> changedLoose;
    std::vector<std::uint32_t>
        changed;  // contacts that touch and did not at the end of the last step, or the reverse
};

/// The pose at hand as the one before the step, and no force for the step any more.
void remember(BodyTable& bodies, std::uint32_t slot);

/// Writes the solved state back to the bodies that take part, measures the contacts where they are now, and
/// says which of them touch. A body whose state is no number is put back where it was, at rest and disabled.
FinalCounts finalize(SolverScratch& solver, MotionTable& motions, ContactTable& contacts,
                     const ShapeTable& shapes, BodyTable& bodies, const StepContext& context,
                     FinalScratch& scratch, Parallel& parallel);

}  // namespace tamias2d::inline TAMIAS_PRECISION
