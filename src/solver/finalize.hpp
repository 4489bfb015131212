// SPDX-License-Identifier: MIT
#pragma once

#include "model/bodies.hpp"
#include "model/contacts.hpp"
#include "model/motion.hpp"
#include "model/shapes.hpp"
#include "model/step_context.hpp"
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

enum class TouchChange : std::uint8_t { Same, Begins, Ends };

struct FinalScratch {
    std::vector<FinalCounts> ofChunks;
    std::vector<TouchChange> touchChanges;  // by contact: since the end of the last step
};

/// The pose at hand as the one before the step, and no force for the step any more.
void remember(BodyTable& bodies, std::uint32_t slot);

/// Writes the solved state back to the bodies that take part, measures the contacts where they are now, and
/// says which of them touch. A body whose state is no number is put back where it was, at rest and disabled.
FinalCounts finalize(MotionTable& motions, ContactTable& contacts, const ShapeTable& shapes,
                     BodyTable& bodies, const StepContext& context, FinalScratch& scratch,
                     Parallel& parallel);

}  // namespace tamias2d::inline TAMIAS_PRECISION
