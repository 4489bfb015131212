// SPDX-License-Identifier: MIT
#pragma once

#include "solver/solve.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// The step in one tick, for those that have been found to be quiet: no impact is near. After it the ticks are
/// for all others. docs/theory/calm.md, section 6.
void tickQuiet(SolverStage& stage, const StepContext& context, ClampCounts& clamps);

}  // namespace tamias2d::inline TAMIAS_PRECISION
