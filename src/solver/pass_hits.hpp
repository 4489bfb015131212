// SPDX-License-Identifier: MIT
#pragma once

#include "solver/impact_stage.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// After the passes of tick number `tick`, before anything drifts: records the impacts that they stopped, all
/// at once. A point is one that carried nothing as the tick began, carries something now, and closed faster
/// than steady forces make it. docs/theory/contacts.md, section 3.
void recordPassHits(ImpactStage& stage, const StepContext& context, int tick);

}  // namespace tamias2d::inline TAMIAS_PRECISION
