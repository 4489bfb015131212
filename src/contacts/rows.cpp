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
    const real separation = dot(n, d + surfaceB - surfaceA);

    // The point goes with the corner, on its surface: the other surface slides past it, and a disc
    // rolls on its own radius.
    PlacedPoint placed;
    placed.gap = separation - contact.restGap;
    placed.armA = anchor.cornerOnA ? surfaceA : surfaceB + d;
    placed.armB = anchor.cornerOnA ? surfaceA - d : surfaceB;
    return placed;
}

void prepareContact(Contact& contact, const Motion& a, const Motion& b)
{
    const Vec2 d = toVec2(b.center - a.center);
    if (contact.count == 1 && normalTurns(contact, contact.points[0].anchor))
        contact.normal = normalOf(contact, contact.points[0].anchor, a.rotation, b.rotation, d);
    const Vec2 n = contact.normal, t = perpendicular(n);
    for (int i = 0; i < contact.count; ++i) {
        ContactPointRow& point = contact.points[i];
        const PlacedPoint placed = placePoint(contact, n, point.anchor, a.rotation, b.rotation, d);
        point.armA = placed.armA;
        point.armB = placed.armB;
        point.gap = placed.gap;
        point.normalMass = compliance(a, placed.armA, n) + compliance(b, placed.armB, n);
        point.tangentMass = compliance(a, placed.armA, t) + compliance(b, placed.armB, t);
    }
    if (contact.count == 2) {
        const ContactPointRow &p = contact.points[0], &q = contact.points[1];
        contact.crossMass = crossCompliance(a, b, n, p.armA, p.armB, q.armA, q.armB);
    }
}

real allowedApproach(const ContactPointRow& point, const StepContext& context)
{
    return point.gap > 0 ? point.gap * context.invH : real(0);
}

real impactThreshold(const Contact& contact, const Motion& a, const Motion& b, const StepContext& context)
{
    const Vec2 n = contact.normal;
    const real forces = context.h * absolute(dot(n, b.acceleration - a.acceleration));
    const real contacts = absolute(dot(n, a.steady)) + absolute(dot(n, b.steady));
    return context.tuning.impactThreshold * (forces + contacts);
}

namespace {

// An approach that only the next impact pass may stop: it is elastic, unloaded and fast. Not so once
// the point is squeezed: left to impacts for ever it would sink.
bool isLeftToImpacts(const Contact& contact, const ContactPointRow& point, real normalSpeed, real threshold,
                     const StepContext& context)
{
    return contact.restitution > 0 && !point.wasLoaded &&
           contact.impacts < context.tuning.impactsPerContact && point.gap > -contact.restGap / 2 &&
           normalSpeed < -threshold;
}

// Has an impact in this tick settled the contact? At its time it has; seen from the start of the tick
// there remains what the bodies turn in between, and that is no approach.
bool isSettledByImpact(const Contact& contact, const Motion& a, const Motion& b, const StepContext& context)
{
    if (contact.impacts == 0 || contact.impacts >= context.tuning.impactsPerContact) return false;
    for (int i = 0; i < contact.count; ++i) {
        const ContactPointRow& point = contact.points[i];
        if (point.wasLoaded || point.gap <= -contact.restGap / 2) return false;
        const Vec2 v = relativeVelocity(point, a, b);
        const real turn = context.h * (absolute(a.spin) + absolute(b.spin));
        const real rim = absolute(a.spin) * length(point.armA) + absolute(b.spin) * length(point.armB);
        if (dot(contact.normal, v) + allowedApproach(point, context) < -turn * (length(v) + rim))
            return false;
    }
    return true;
}

// A point alone, unless its approach is left to impacts.
real visitNormal(Contact& contact, ContactPointRow& point, Motion& a, Motion& b, real threshold,
                 const StepContext& context)
{
    if (!(point.normalMass > 0)) {  // both bodies locked against it: no load shows
        point.normalImpulse = 0;
        return 0;
    }
    const real normalSpeed = dot(contact.normal, relativeVelocity(point, a, b));
    if (isLeftToImpacts(contact, point, normalSpeed, threshold, context)) return 0;
    return solveNormal(contact, point, a, b, allowedApproach(point, context));
}

void visitFriction(const Contact& contact, ContactPointRow& point, Motion& a, Motion& b)
{
    if (point.tangentMass > 0)
        solveFriction(contact, point, a, b);
    else
        point.tangentImpulse = 0;
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

real solveContact(Contact& contact, Motion& a, Motion& b, const StepContext& context)
{
    if (contact.count == 0) return 0;
    if (isSettledByImpact(contact, a, b, context)) return 0;
    const bool resting =
        contact.restitution <= 0 || (contact.points[0].wasLoaded && contact.points[1].wasLoaded);

    real change = 0;
    bool solved = false;
    if (contact.count == 2 && resting) {
        const real allowed[2] = {allowedApproach(contact.points[0], context),
                                 allowedApproach(contact.points[1], context)};
        change = solveNormalsAsBlock(contact, a, b, allowed[0], allowed[1], solved);
    }
    if (!solved) {
        const real threshold = impactThreshold(contact, a, b, context);
        for (int i = 0; i < contact.count; ++i)
            change = maximum(change, visitNormal(contact, contact.points[i], a, b, threshold, context));
    }
    for (int i = 0; i < contact.count; ++i) visitFriction(contact, contact.points[i], a, b);
    solveRolling(contact, a, b);
    return change;
}

void addSteady(const Contact& contact, Motion& a, Motion& b)
{
    const Vec2 n = contact.normal, t = perpendicular(n);
    for (int i = 0; i < contact.count; ++i) {
        const ContactPointRow& point = contact.points[i];
        const Vec2 impulse = point.normalImpulse * n + point.tangentImpulse * t;
        a.steady -= {a.invMass.x * impulse.x, a.invMass.y * impulse.y};
        a.steadySpin -= a.invInertia * cross(point.armA, impulse);
        b.steady += {b.invMass.x * impulse.x, b.invMass.y * impulse.y};
        b.steadySpin += b.invInertia * cross(point.armB, impulse);
    }
    a.steadySpin -= a.invInertia * contact.rollingImpulse;
    b.steadySpin += b.invInertia * contact.rollingImpulse;
}

void limitSteady(Motion& m, const StepContext& context)
{
    const auto limited = [&](real change, double mostSpeed) {
        if (std::isnan(change)) return real(0);  // of two infinite loads against each other
        const real most = static_cast<real>(2 * mostSpeed / context.ticks);
        return clamp(change, -most, most);
    };
    const double mostSpeed = kMaxSpeed * static_cast<double>(context.lengthUnit);
    m.steady = {limited(m.steady.x, mostSpeed), limited(m.steady.y, mostSpeed)};
    m.steadySpin = limited(m.steadySpin, kMaxSpin);
}

namespace {

void applyPush(const Motion& m, Push& push, Vec2 arm, Vec2 impulse, real sign)
{
    push.shift += sign * Vec2{m.invMass.x * impulse.x, m.invMass.y * impulse.y};
    push.turn += sign * m.invInertia * cross(arm, impulse);
}

// Speed asked of the push at a point, as its bias. It aims short of the rest gap, by pushSlack of it, so
// that a corner at rest does not flicker between pushed and not.
real pushBias(const Contact& contact, const ContactPointRow& point, const StepContext& context,
              ClampCounts& clamps)
{
    const real gap = point.gap + context.tuning.pushSlack * contact.restGap;
    if (gap > 0) return gap * context.invH;
    const real wanted = context.tuning.pushRate * gap * context.invH;
    const real most = context.pushSpeed() * static_cast<real>(context.ticks);
    if (wanted >= -most) return wanted;
    ++clamps.push;
    return -most;
}

}  // namespace

void pushContact(Contact& contact, const Motion& a, const Motion& b, Push& pushA, Push& pushB,
                 const StepContext& context, ClampCounts& clamps)
{
    const Vec2 n = contact.normal;
    real bias[2] = {};
    for (int i = 0; i < contact.count; ++i)
        if (contact.points[i].normalMass > 0) bias[i] = pushBias(contact, contact.points[i], context, clamps);
    const auto residual = [&](int i) {
        const ContactPointRow& p = contact.points[i];
        const Vec2 v = pushB.shift + cross(pushB.turn, p.armB) - pushA.shift - cross(pushA.turn, p.armA);
        return dot(n, v) + bias[i];
    };
    const auto add = [&](ContactPointRow& p, real total) {
        const Vec2 impulse = (total - p.pushImpulse) * n;
        applyPush(a, pushA, p.armA, impulse, -1);
        applyPush(b, pushB, p.armB, impulse, 1);
        p.pushImpulse = total;
    };

    if (contact.count == 2) {
        ContactPointRow &p = contact.points[0], &q = contact.points[1];
        const real k12 = contact.crossMass;
        const real r1 = residual(0) - p.normalMass * p.pushImpulse - k12 * q.pushImpulse;
        const real r2 = residual(1) - k12 * p.pushImpulse - q.normalMass * q.pushImpulse;
        real x1, x2;
        if (solveBlock(p.normalMass, q.normalMass, k12, r1, r2, x1, x2)) {
            add(p, x1);
            add(q, x2);
            return;
        }
    }
    for (int i = 0; i < contact.count; ++i) {
        ContactPointRow& p = contact.points[i];
        if (p.normalMass > 0) add(p, maximum(real(0), p.pushImpulse - residual(i) / p.normalMass));
    }
}

void repayPush(Contact& contact, Motion& a, Motion& b, real h)
{
    real pushed = 0, load = 0;
    for (int i = 0; i < contact.count; ++i) {
        pushed += contact.points[i].pushImpulse;
        load += contact.points[i].normalImpulse;
    }
    const Vec2 d = toVec2(b.center - a.center);
    const real squared = dot(d, d);
    if (!(pushed > 0) || !(load > 0) || !a.isFree() || !b.isFree() || !(squared > 0)) return;
    const real gained = h * pushed * cross(contact.normal, b.velocity - a.velocity);
    const Vec2 impulse = -gained / squared * perpendicular(d);
    applyImpulse(a, b, {}, {}, impulse);
    contact.stepImpulse += impulse;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
