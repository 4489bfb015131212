// SPDX-License-Identifier: MIT
#pragma once

#include "contacts/row_kernel.hpp"
#include "model/contacts.hpp"
#include "model/motion.hpp"
#include "model/step_context.hpp"
#include "narrowphase/face_kernel.hpp"

#include <tamias2d/model/clamps.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The contact's normal for rotations `qA`, `qB` and centers `d` = B - A apart: where two roundings meet
/// it runs through both their centers, wherever these have gone.
Vec2 normalOf(const Contact& contact, const ManifoldPoint& anchor, Rot qA, Rot qB, Vec2 d);

/// Does the normal go along from tick to tick? Not that of a plastic round body on a sharp corner, which
/// may be the seam of a floor it glides over: there the manifold's, of the whole way, is the right one.
bool normalTurns(const Contact& contact, const ManifoldPoint& anchor);

/// The point along `normal`, for rotations `qA`, `qB` and centers `d` = B - A apart. Both arms lead to one
/// place, so that no impulse at it changes the angular momentum of the two [GD1].
PlacedPoint placePoint(const Contact& contact, Vec2 normal, const ManifoldPoint& anchor, Rot qA, Rot qB,
                       Vec2 d);

/// Normal, arms and gaps at the present poses.
void placeContact(Contact& contact, const Motion& a, const Motion& b);
/// The same, and effective masses.
void prepareContact(Contact& contact, const Motion& a, const Motion& b);

/// Speed at which the point may still close: as far as its gap within the tick, and no further.   [m/s]
real allowedApproach(const ContactPointRow& point, const StepContext& context);

/// Slowest approach that is an impact: more than what steady forces do within a tick, and than what of them
/// is not balanced, so that what rests never bounces; zero without such forces.   [m/s]
real impactThreshold(const Contact& contact, const Motion& a, const Motion& b, const StepContext& context);
/// The same where contacts carry so much of the speeds of both along the normal, each taken positive.   [m/s]
real impactThreshold(const Contact& contact, const Motion& a, const Motion& b, real carried,
                     const StepContext& context);

/// What closes by more rest gaps in a tick is an impact at its time in crowds as well: 3 % of the smaller
/// width at the defaults [ADR21].
inline constexpr real kSlowInCrowd = 30;

/// What closes by less of a rest gap in a tick is no impact. It would take three weeks to close one; but
/// rounding brings what is wedged in without any forces to hit both sides by turns for ever.
inline constexpr real kUnseen = real(1e-9);

/// Slower than this nothing is an impact, whatever the forces: it is left to the passes. In a crowd each loss
/// makes others meet, a little later and a little slower, without end; the passes stop all of it at once.
/// What would have bounced then loses less than a rest gap a tick of speed [ADR21].   [m/s]
real leastApproach(const Contact& contact, const StepContext& context);

/// How many impacts of a contact may act in a tick; what approaches after them is left to the passes. One
/// that does not bounce, or bounces with losses in a crowd, and is hit again and again stands in such a
/// chain: the passes take it after a fourth of Tuning::impactsPerContact [ADR21].
int mostImpacts(const Contact& contact, const StepContext& context);

/// Is an approach at the point left to the next impact, at these velocities?
bool isLeftToImpacts(const Contact& contact, int point, const Motion& a, const Motion& b,
                     const StepContext& context);
/// After an impact in this tick: how fast its points may still close [m/s], which is but what the bodies turn
/// meanwhile; 0 if the passes have to stop them.
real slackOfImpact(const Contact& contact, const ContactPointRow& point, const Motion& a, const Motion& b,
                   const StepContext& context);

/// One pass over a contact: normal impulses, then friction on the slip they leave, then rolling
/// resistance. Returns the greatest change of normal speed it made.   [m/s]
real solveContact(Contact& contact, Motion& a, Motion& b, const StepContext& context);

/// The contact as the passes take it, from what prepareContact left.
ContactRow<real> rowOf(const Contact& contact, const Motion& a, const Motion& b, const StepContext& context);

/// What pushing asks of a point.   [m/s]
real pushBiasOf(real gap, real restGap, const StepContext& context, ClampCounts& clamps);

/// One pass of pushing over a contact: displacements that undo overlaps, as velocities over one tick. They
/// move bodies and leave velocities alone.
void pushContact(Contact& contact, const Motion& a, const Motion& b, BodyMotion<real>& pushA,
                 BodyMotion<real>& pushB, const StepContext& context, ClampCounts& clamps);

/// Takes back the angular momentum that the push gave two bodies that slide along each other [GD1].
void repayPush(Contact& contact, const Motion& a, const Motion& b, Vec2& velocityA, Vec2& velocityB,
               const StepContext& context);

/// Adds the velocity changes by what a contact carries.
void addSteady(const ContactLoad& load, const Motion& a, const Motion& b, BodyMotion<real>& steadyA,
               BodyMotion<real>& steadyB);

/// Adds what it does in a tick to its sums of the step, so many times.
void addToSums(Contact& contact, int ticks);

/// What it carries, by the arms that it has.
ContactLoad loadOf(const Contact& contact);
/// Adds the velocity changes by that, in a tick, to what the bodies are expected to have.
void addLoad(const ContactLoad& load, Motion& a, Motion& b);

/// Holds the sum of these changes to what forces may do in a tick. Loads of a heavy body would throw it out
/// of the world, and infinities into its neighbors, when its mass has just been set to a tiny one.
void limitSteady(Motion& m, const StepContext& context);

}  // namespace tamias2d::inline TAMIAS_PRECISION
