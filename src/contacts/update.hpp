// SPDX-License-Identifier: MIT
#pragma once

#include "model/contacts.hpp"
#include "model/motion.hpp"
#include "model/shapes.hpp"
#include "model/step_context.hpp"
#include "narrowphase/swept.hpp"

#include <tamias2d/model/clamps.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The acceleration a body is expected to have: forces, damping and steady contacts.   [m/s^2]
Vec2 expectedAcceleration(const Motion& m, real invH);
real expectedSpinRate(const Motion& m, real invH);   ///< [rad/s^2]

/// The way of a body that nothing hits, seen from `origin`.
Trajectory predictedPath(const Motion& m, Position origin, real invH);

/// The place a pair is seen from: the center of the smaller body, where `real` resolves best.
Position originOf(const Motion& a, const Motion& b);

/// Both ways of a pair, seen from there.
SweptPair sweptPairOf(const Contact& contact, const ShapeTable& shapes, const Motion& a, const Motion& b,
                      real invH);

/// Takes over a manifold; points that were there before keep their impulses, known by their feature
/// or, failing that, by the nearest anchor.
void adoptManifold(Contact& contact, const SweptResult& result, real matchDistance);

/// The manifold of the whole step, from 0 to dt. Pairs that may still meet in another way are
/// flagged `swept`: they are looked at again in every tick.
void updateForStep(Contact& contact, const ShapeTable& shapes, const MotionTable& motions,
                   const StepContext& context, ClampCounts& clamps);

}  // namespace tamias2d::inline TAMIAS_PRECISION
