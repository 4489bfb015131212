// SPDX-License-Identifier: MIT
// The rows of a contact: what it asks of the velocities of its two bodies, and how the answer
// becomes impulses. Derivation and symbols: docs/theory/contacts.md, sections 3 and 4.

#include "contacts/rows.hpp"

#include <tamias2d/model/defs.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

Vec2 normalOf(const Contact& contact, const ManifoldPoint& anchor, Rot qA, Rot qB, Vec2 d)
{
    if (!anchor.roundOnRound) return contact.normal;
    const Vec2 between = d + rotate(qB, anchor.localB) - rotate(qA, anchor.localA);
    const real distance = length(between);
    return distance > 0 ? (1 / distance) * between : contact.normal;
}

bool normalTurns(const Contact& contact, const ManifoldPoint& anchor)
{
    const bool bothRound = contact.radiusA > 0 && contact.radiusB > 0;
    return anchor.roundOnRound && (bothRound || contact.restitution > 0);
}

PlacedPoint placePoint(const Contact& contact, Vec2 n, const ManifoldPoint& anchor, Rot qA, Rot qB, Vec2 d)
{
    const Vec2 surfaceA = rotate(qA, anchor.localA) + contact.radiusA * n;  // from the center of A
    const Vec2 surfaceB = rotate(qB, anchor.localB) - contact.radiusB * n;  // from the center of B
    return placedPoint(n, surfaceA, surfaceB, d, anchor.cornerOnA, contact.restGap);
}

void placeContact(Contact& contact, const Motion& a, const Motion& b)
{
    const Vec2 d = toVec2(b.center - a.center);
    if (contact.count == 1 && normalTurns(contact, contact.points[0].anchor))
        contact.normal = normalOf(contact, contact.points[0].anchor, a.rotation, b.rotation, d);
    for (int i = 0; i < contact.count; ++i) {
        ContactPointRow& point = contact.points[i];
        const PlacedPoint placed =
            placePoint(contact, contact.normal, point.anchor, a.rotation, b.rotation, d);
        point.armA = placed.armA;
        point.armB = placed.armB;
        point.gap = placed.gap;
    }
}

void prepareContact(Contact& contact, const Motion& a, const Motion& b)
{
    placeContact(contact, a, b);
    const Vec2 n = contact.normal, t = perpendicular(n);
    for (int i = 0; i < contact.count; ++i) {
        ContactPointRow& point = contact.points[i];
        point.normalMass = compliance(a, point.armA, n) + compliance(b, point.armB, n);
        point.tangentMass = compliance(a, point.armA, t) + compliance(b, point.armB, t);
    }
}

real allowedApproach(const ContactPointRow& point, const StepContext& context)
{
    return point.gap > 0 ? point.gap * context.invH : real(0);
}

real impactThreshold(const Contact& contact, const Motion& a, const Motion& b, real carried,
                     const StepContext& context)
{
    return context.tuning.impactThreshold *
           steadyApproach(contact.normal, b.acceleration - a.acceleration, carried, context.h);
}

real impactThreshold(const Contact& contact, const Motion& a, const Motion& b, const StepContext& context)
{
    const SteadyForces<real> onA{a.steady, a.acceleration}, onB{b.steady, b.acceleration};
    return context.tuning.impactThreshold * steadyApproach(contact.normal, onA, onB, context.h);
}

// In crowds a bounce is left out whose rebound is slower than 1 - C_R rest gaps a tick.
real leastApproach(const Contact& contact, const StepContext& context)
{
    const real kept = contact.restitution, lost = 1 - kept;
    const real inCrowd = lost < kSlowInCrowd * kept ? lost / kept : kSlowInCrowd;
    const real gaps = contact.crowded ? maximum(inCrowd, kUnseen) : kUnseen;
    return gaps * contact.restGap * context.invH;
}

int mostImpacts(const Contact& contact, const StepContext& context)
{
    const int most = context.tuning.impactsPerContact;
    const bool chains = !(contact.restitution > 0) || (contact.crowded && contact.restitution < 1);
    return chains ? (most + 3) / 4 : most;
}

namespace {

// Velocity of B against A at the point.   [m/s]
Vec2 relativeVelocity(const ContactPointRow& point, const Motion& a, const Motion& b)
{
    return (b.velocity + cross(b.spin, point.armB)) - (a.velocity + cross(a.spin, point.armA));
}

// An approach that only the next impact pass may stop: it is elastic, unloaded and fast. Not so once
// the point is squeezed: left to impacts for ever it would sink.
bool isLeftToImpacts(const Contact& contact, const ContactPointRow& point, real normalSpeed, real threshold,
                     const StepContext& context)
{
    return contact.restitution > 0 && !point.wasLoaded && contact.impacts < mostImpacts(contact, context) &&
           point.gap > -contact.restGap / 2 &&
           normalSpeed < -maximum(threshold, leastApproach(contact, context));
}

// May an impact in this tick have settled the contact?
bool isAfterImpact(const Contact& contact, const ContactPointRow& point, const StepContext& context)
{
    if (contact.impacts == 0 || contact.impacts >= mostImpacts(contact, context)) return false;
    return !point.wasLoaded && point.gap > -contact.restGap / 2;
}

// Has it? At its time it has; seen from the start of the tick there remains what the bodies turn in between,
// and that is no approach.
bool isSettledByImpact(const Contact& contact, const Motion& a, const Motion& b, const StepContext& context)
{
    for (int i = 0; i < contact.count; ++i) {
        const ContactPointRow& point = contact.points[i];
        if (!isAfterImpact(contact, point, context)) return false;
        if (dot(contact.normal, relativeVelocity(point, a, b)) + allowedApproach(point, context) <
            -slackOfImpact(contact, point, a, b, context))
            return false;
    }
    return contact.impacts > 0;
}

// A point alone, unless its approach is left to impacts.
real visitNormal(const Contact& contact, int k, ContactRow<real>& row, BodyMotion<real>& a,
                 BodyMotion<real>& b, real threshold, const StepContext& context)
{
    PointRow<real>& p = row.points[k];
    const real closing = dot(row.normal, b.velocity - a.velocity);
    const real residual = normalResidual(p, closing, a, b);
    if (isLeftToImpacts(contact, contact.points[k], residual - p.allowed, threshold, context)) return 0;
    const real total = maximum(p.normalImpulse - residual * p.normalInverse, real(0));
    const real change = total - p.normalImpulse;
    p.normalImpulse = total;
    applyAtCenters(row, change, real(0), a.velocity, b.velocity);
    a.spin -= row.invInertiaA * (p.turnA * change);
    b.spin += row.invInertiaB * (p.turnB * change);
    return absolute(p.normalMass * change);
}

void solveRolling(Contact& contact, Motion& a, Motion& b)
{
    const real k = a.invInertia + b.invInertia;
    if (!(k > 0)) {
        contact.rollingImpulse = 0;
        return;
    }
    if (!(contact.rolling > 0) && contact.rollingImpulse == 0) return;
    real load = 0;
    for (int i = 0; i < contact.count; ++i) load += contact.points[i].normalImpulse;
    const real limit = contact.rolling * load;
    const real total = clamp(contact.rollingImpulse - (b.spin - a.spin) / k, -limit, limit);
    const real change = total - contact.rollingImpulse;
    a.spin -= a.invInertia * change;
    b.spin += b.invInertia * change;
    contact.rollingImpulse = total;
}

}  // namespace

real slackOfImpact(const Contact& contact, const ContactPointRow& point, const Motion& a, const Motion& b,
                   const StepContext& context)
{
    if (!isAfterImpact(contact, point, context)) return 0;
    const real turn = context.h * (absolute(a.spin) + absolute(b.spin));
    const real rim = absolute(a.spin) * length(point.armA) + absolute(b.spin) * length(point.armB);
    return turn * (length(relativeVelocity(point, a, b)) + rim);
}

bool isLeftToImpacts(const Contact& contact, int point, const Motion& a, const Motion& b,
                     const StepContext& context)
{
    const ContactPointRow& p = contact.points[point];
    const real closing = dot(contact.normal, relativeVelocity(p, a, b));
    return isLeftToImpacts(contact, p, closing, impactThreshold(contact, a, b, context), context);
}

ContactRow<real> rowOf(const Contact& contact, const Motion& a, const Motion& b, const StepContext& context)
{
    ContactRow<real> row{};
    row.normal = contact.normal;
    row.invMassA = a.invMass;
    row.invMassB = b.invMass;
    row.invInertiaA = a.invInertia;
    row.invInertiaB = b.invInertia;
    row.friction = contact.friction;
    row.surfaceSpeed = contact.surfaceSpeed;
    const real linear = prepareCenters(row);
    for (int k = 0; k < contact.count; ++k) {
        const ContactPointRow& point = contact.points[k];
        row.points[k].normalImpulse = point.normalImpulse;
        row.points[k].tangentImpulse = point.tangentImpulse;
        preparePoint(row, row.points[k], linear, point.armA, point.armB, point.gap, context.invH, true);
    }
    if (contact.count == 2) prepareBlock(row, linear);
    return row;
}

real solveContact(Contact& contact, Motion& a, Motion& b, const StepContext& context)
{
    if (contact.count == 0) return 0;
    if (isSettledByImpact(contact, a, b, context)) return 0;
    bool resting = true;
    for (int i = 0; i < contact.count; ++i)
        resting = resting && (contact.restitution <= 0 || contact.points[i].wasLoaded);

    ContactRow<real> row = rowOf(contact, a, b, context);
    BodyMotion<real> motionA{a.velocity, a.spin}, motionB{b.velocity, b.spin};
    real change = 0;
    if (resting) {
        change = solveRow(row, contact.count, motionA, motionB);
    } else {
        const real threshold = impactThreshold(contact, a, b, context);
        for (int k = 0; k < contact.count; ++k)
            change = maximum(change, visitNormal(contact, k, row, motionA, motionB, threshold, context));
        solveFrictions(row, contact.count, {}, motionA, motionB);
    }
    for (int k = 0; k < contact.count; ++k) {
        contact.points[k].normalImpulse = row.points[k].normalImpulse;
        contact.points[k].tangentImpulse = row.points[k].tangentImpulse;
    }
    a.velocity = motionA.velocity, a.spin = motionA.spin;
    b.velocity = motionB.velocity, b.spin = motionB.spin;
    solveRolling(contact, a, b);
    return change;
}

void addSteady(const ContactLoad& load, const Motion& a, const Motion& b, BodyMotion<real>& steadyA,
               BodyMotion<real>& steadyB)
{
    steadyA.velocity -= {a.invMass.x * load.impulse.x, a.invMass.y * load.impulse.y};
    steadyA.spin -= a.invInertia * load.momentA;
    steadyB.velocity += {b.invMass.x * load.impulse.x, b.invMass.y * load.impulse.y};
    steadyB.spin += b.invInertia * load.momentB;
}

void addToSums(Contact& contact, int ticks)
{
    const real times = static_cast<real>(ticks);
    const Vec2 n = contact.normal, t = perpendicular(n);
    for (int i = 0; i < contact.count; ++i) {
        ContactPointRow& point = contact.points[i];
        const real normal = times * point.normalImpulse, tangent = times * point.tangentImpulse;
        point.stepNormal += normal;
        point.stepTangent += tangent;
        contact.stepImpulse += normal * n + tangent * t;
    }
}

ContactLoad loadOf(const Contact& contact)
{
    ContactRow<real> row{};
    row.normal = contact.normal;
    for (int k = 0; k < contact.count; ++k) {
        const ContactPointRow& point = contact.points[k];
        PointRow<real>& p = row.points[k];
        setArms(p, row.normal, point.armA, point.armB);
        p.normalImpulse = point.normalImpulse;
        p.tangentImpulse = point.tangentImpulse;
    }
    ContactLoad load = carriedBy(row, contact.count);
    load.momentA += contact.rollingImpulse;
    load.momentB += contact.rollingImpulse;
    return load;
}

void addLoad(const ContactLoad& load, Motion& a, Motion& b)
{
    BodyMotion<real> steadyA{a.steady, a.steadySpin}, steadyB{b.steady, b.steadySpin};
    addSteady(load, a, b, steadyA, steadyB);
    a.steady = steadyA.velocity, a.steadySpin = steadyA.spin;
    b.steady = steadyB.velocity, b.steadySpin = steadyB.spin;
}

void limitSteady(Motion& m, const StepContext& context)
{
    m.steady = {limitedChange(m.steady.x, context.mostSteady), limitedChange(m.steady.y, context.mostSteady)};
    m.steadySpin = limitedChange(m.steadySpin, context.mostSteadySpin);
}

// It aims short of the rest gap, by pushSlack of it, so that a corner at rest does not flicker between pushed
// and not.
real pushBiasOf(real gap, real restGap, const StepContext& context, ClampCounts& clamps)
{
    const real off = gap + context.tuning.pushSlack * restGap, most = context.mostPush();
    if (off <= 0 && context.tuning.pushRate * off * context.invH < -most) ++clamps.push;
    return pushBias(off, context.invH, context.tuning.pushRate, most);
}

void pushContact(Contact& contact, const Motion& a, const Motion& b, BodyMotion<real>& pushA,
                 BodyMotion<real>& pushB, const StepContext& context, ClampCounts& clamps)
{
    contact.pushed = 0;
    if (contact.count == 0) return;
    real bias[2] = {};
    for (int i = 0; i < contact.count; ++i)
        if (contact.points[i].normalMass > 0)
            bias[i] = pushBiasOf(contact.points[i].gap, contact.restGap, context, clamps);
    const ContactRow<real> row = rowOf(contact, a, b, context);
    contact.pushed = pushRow(row, contact.count, bias[0], bias[1], pushA, pushB);
}

void repayPush(Contact& contact, const Motion& a, const Motion& b, Vec2& velocityA, Vec2& velocityB,
               const StepContext& context)
{
    if (!(contact.pushed > 0)) return;
    real load = 0;
    for (int i = 0; i < contact.count; ++i) load += contact.points[i].normalImpulse;
    const ContactRow<real> row = rowOf(contact, a, b, context);
    contact.stepImpulse +=
        repayPush(row, contact.pushed, load, toVec2(b.center - a.center), context.h, velocityA, velocityB);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
