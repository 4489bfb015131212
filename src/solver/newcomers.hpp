// SPDX-License-Identifier: MIT
#pragma once

#include "solver/impact_stage.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// Gives a body that has none a row in mid-step, behind all others.
void enter(ImpactStage& stage, std::uint32_t body, const StepContext& context);

/// Brings a sleeping group into the step at the start of a tick: its bodies, its contacts with the load they
/// carry, an island of its own. The tables of the world follow when the step is over.
void rouse(ImpactStage& stage, std::uint32_t group, const StepContext& context, double time);

}  // namespace tamias2d::inline TAMIAS_PRECISION
