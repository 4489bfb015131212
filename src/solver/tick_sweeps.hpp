// SPDX-License-Identifier: MIT
#pragma once

#include "solver/impact_stage.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// What the impact stage asks of a contact.
PairRow pairRowOf(const Contact& contact);

/// How far a body may leave the way that its boxes were made for: they hold a little more than it. `width` is
/// that of its narrowest shape.   [m]
real slackOf(real width, const StepContext& context);

/// What holds for all ticks of a step. Of the contacts only those that are `renewed`, which may be null, are
/// others than at the end of the last step.
void startSweeps(ImpactStage& stage, const std::vector<std::uint8_t>* renewed);

/// The ways that the boxes of bodies were made for, of all but quiet ones.
void predictWays(ImpactStage& stage, const StepContext& context);
/// That of one.
void predictWay(ImpactStage& stage, std::uint32_t row, const StepContext& context);

/// From the next tick on a pair is swept.
void sweepFromNowOn(ImpactStage& stage, std::uint32_t contact);

/// Looks again at the swept pairs, over this tick alone: at those that may meet in it, by how they are apart.
/// docs/theory/contacts.md, section 3.
void resweepForTick(ImpactStage& stage, const StepContext& context);

/// Gives back how pairs are apart at the end of the step.
void endSweeps(ImpactStage& stage);

}  // namespace tamias2d::inline TAMIAS_PRECISION
