// SPDX-License-Identifier: MIT
#pragma once

#include "model/bodies.hpp"
#include "model/contacts.hpp"
#include "model/motion.hpp"
#include "model/shapes.hpp"
#include "model/step_context.hpp"
#include "tasks/parallel.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

struct FinalCounts {
    std::uint32_t nonFinite = 0;   // bodies set aside
    std::uint32_t stopped = 0;     // at the edge of the world
    double deepestOverlap = 0;     // [m]
};

/// The pose at hand as the one before the step, and no force for the step any more.
void remember(BodyTable& bodies, std::uint32_t slot);

/// Writes the solved state back to the bodies that take part and measures the contacts where they are now. A
/// body whose state is no number is put back where it was, at rest and disabled.
FinalCounts finalize(MotionTable& motions, ContactTable& contacts, const ShapeTable& shapes,
                     BodyTable& bodies, const StepContext& context, std::vector<FinalCounts>& ofChunks,
                     Parallel& parallel);

/// Does some point of the contact count as touching? Gaps must be those of the present poses.
bool isTouching(const Contact& contact, const Tuning& tuning);

}  // namespace tamias2d::inline TAMIAS_PRECISION
