// SPDX-License-Identifier: MIT
#pragma once

#include "solver/impact_stage.hpp"
#include "solver/joint_passes.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// After the passes of a tick: contacts of bodies that joints tie, and that go another way in it than it was
/// begun for, in turn or in line. Where that way leads one body deeper into another by more than so many rest
/// gaps, the contact is aimed at where it does: its manifold is the one of that way, and its rows are lines
/// through the places at the end of it. Says in stage.scratch.turned which, and their islands, for passes
/// once more; returns whether there are any. docs/theory/joints.md, section 9.
bool aimTurnedContacts(ImpactStage& stage, const StepContext& context, real restGaps);

/// Where these passes found no way out of a ground, the bodies of the group stay where they are in this tick,
/// at rest with the ground. Returns how many that stops.
std::uint32_t stopTurned(ImpactStage& stage);

/// A group that met a ground and is lost, and would be torn by turning on, is slowed down until it is not.
/// Returns how many bodies that slows.
std::uint32_t slowTorn(ImpactStage& stage, const JointWorld& world);

}  // namespace tamias2d::inline TAMIAS_PRECISION
