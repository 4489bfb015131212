// SPDX-License-Identifier: MIT
#pragma once

#include "solver/impact_stage.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// Finds the impacts of one tick and applies each at its time. `tick` is its number within the step.
/// Contacts must be prepared at the present poses. docs/theory/contacts.md, section 3.
void applyImpacts(ImpactStage& stage, const StepContext& context, int tick);

/// Starts tick number `tick` of the step for all bodies: see BodyKernels.
void startTick(ImpactStage& stage, const StepContext& context, int tick);

}  // namespace tamias2d::inline TAMIAS_PRECISION
