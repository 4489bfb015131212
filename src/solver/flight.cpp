// SPDX-License-Identifier: MIT
// When and how two bodies on their ways through a tick meet: a parabola for each point, then Newton's
// method on the true gap of the turning bodies. docs/theory/contacts.md, section 3.

#include "solver/flight.hpp"

#include "contacts/update.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

Flight flightOf(const Motion& m, real invH)
{
    Flight flight;
    flight.velocity = m.velocity;
    flight.spin = m.spin;
    if (!m.moves()) return flight;
    flight.acceleration = expectedAcceleration(m, invH);
    flight.spinRate = expectedSpinRate(m, invH);
    return flight;
}

Moment momentAt(const Contact& contact, const ManifoldPoint& anchor, const FlyingPair& pair, real t)
{
    const Flight &fa = pair.flightA, &fb = pair.flightB;
    const auto rotationOf = [t](const Motion& m, const Flight& f) {
        const real turn = f.turnAt(t);
        return turn == 0 ? m.rotation : Rot::ofAngle(m.angle + static_cast<double>(turn));
    };
    const Vec2 d = toVec2(pair.b.center - pair.a.center) + fb.shiftAt(t) - fa.shiftAt(t);
    const Rot qA = rotationOf(pair.a, fa), qB = rotationOf(pair.b, fb);

    Moment moment;
    moment.normal = normalOf(contact, anchor, qA, qB, d);
    moment.place = placePoint(contact, moment.normal, anchor, qA, qB, d);
    moment.velocityA = fa.velocity + t * fa.acceleration;
    moment.velocityB = fb.velocity + t * fb.acceleration;
    moment.spinA = fa.spin + t * fa.spinRate;
    moment.spinB = fb.spin + t * fb.spinRate;
    return moment;
}

ImpactPoint impactPoint(const Contact& contact, int k, const FlyingPair& pair)
{
    const ContactPointRow& row = contact.points[k];
    const bool plain = !contact.atImpact && !normalTurns(contact, row.anchor);
    if (plain) return {contact.normal, row.armA, row.armB, row.gap};

    const real t = contact.atImpact ? contact.time : pair.start();
    const Moment at = momentAt(contact, row.anchor, pair, t);
    ImpactPoint point{at.normal, at.place.armA, at.place.armB, at.place.gap};
    point.gap -= dot(point.normal, pair.flightB.shiftAt(t) - pair.flightA.shiftAt(t)) +
                 cross(point.armB, point.normal) * pair.flightB.turnAt(t) -
                 cross(point.armA, point.normal) * pair.flightA.turnAt(t);
    return point;
}

namespace {

// When the point's gap, a parabola in time, first reaches zero while closing fast enough.
real parabolaTime(const Contact& c, int k, const ImpactPoint& point, const FlyingPair& pair, real threshold,
                  const StepContext& context)
{
    const Flight &fa = pair.flightA, &fb = pair.flightB;
    const Vec2 n = point.normal;
    const real turnA = cross(point.armA, n), turnB = cross(point.armB, n);
    const real offset = dot(n, fb.offset - fa.offset) + turnB * fb.turned - turnA * fa.turned;
    const real speed = dot(n, fb.velocity - fa.velocity) + turnB * fb.spin - turnA * fa.spin;
    const real push = dot(n, fb.acceleration - fa.acceleration) + turnB * fb.spinRate - turnA * fa.spinRate;

    // Anchors of a turning body run on circles: counts for the time, not for the speed.
    real bend = push;
    const bool turns = (absolute(fa.spin) + absolute(fb.spin)) * context.h >= real(0.05);
    if (turns && !c.atImpact) {
        const Vec2 coreA = rotate(pair.a.rotation, c.points[k].anchor.localA);
        const Vec2 coreB = rotate(pair.b.rotation, c.points[k].anchor.localB);
        bend += fa.spin * fa.spin * dot(n, coreA) - fb.spin * fb.spin * dot(n, coreB);
    }

    // What turns with the two was placed at the start of the search, else at the start of the tick.
    const real start = pair.start();
    const real before = normalTurns(c, c.points[k].anchor) ? push : bend;
    const real gap = point.gap + offset + speed * start + before * start * start / 2;
    const real closing = speed + before * start;
    real t = start;
    if (gap > 0) {
        const real discriminant = closing * closing - 2 * bend * gap;
        if (discriminant < 0) return kNever;
        const real root = std::sqrt(discriminant);
        if (closing < 0)
            t = start + 2 * gap / (root - closing);
        else if (bend < 0)
            t = start + (-closing - root) / bend;
        else
            return kNever;
        if (!(t <= context.h)) return kNever;
    }
    const real approach = speed + push * t;
    return approach < -threshold ? t : kNever;
}

// The time at which the true gap of the turning bodies closes, by Newton's method; kNever if by their
// true motion they part or only graze, or do not meet within the tick.
real refined(const Contact& c, const ManifoldPoint& anchor, const FlyingPair& pair, real t, real threshold,
             real h)
{
    constexpr int kMaxIterations = 6;
    for (int i = 0;; ++i) {
        const Moment moment = momentAt(c, anchor, pair, t);
        const real speed = moment.normalSpeed();
        if (!(speed < -threshold)) return kNever;
        if (absolute(moment.place.gap) < real(0.001) * c.restGap) return t;
        if (i == kMaxIterations) return t < h || moment.place.gap < real(0.05) * c.restGap ? t : kNever;
        t = clamp(t - moment.place.gap / speed, pair.start(), h);
    }
}

}  // namespace

real travelWithin(const Flight& a, const Motion& ma, const Flight& b, const Motion& mb, real h)
{
    const real turn = ma.extent * (absolute(a.spin) + h * absolute(a.spinRate)) +
                      mb.extent * (absolute(b.spin) + h * absolute(b.spinRate));
    return h * (length(b.velocity - a.velocity) + h * length(b.acceleration - a.acceleration) + turn);
}

real slowestInCrowd(const Contact& c, const StepContext& context)
{
    constexpr real kSlow = 10;  // rest gaps a tick: a hundredth of the smaller width
    return c.crowded && !(c.restitution > 0) ? kSlow * c.restGap * context.invH : real(0);
}

Impact nextImpact(const Contact& c, const ImpactPoint points[2], const FlyingPair& pair,
                  const StepContext& context)
{
    Impact next;
    if (c.impacts >= mostImpacts(c, context)) return next;
    // What impacts of this tick have left of an approach is not the work of steady forces; but there is an
    // end to it, as friction at an impact may turn the bodies on towards each other by ever less.
    real threshold = impactThreshold(c, pair.a, pair.b, context);
    if (c.impacts > 0) threshold = maximum(threshold / 3, real(1e-4) * c.fastestImpact);
    threshold = maximum(threshold, slowestInCrowd(c, context));
    for (int k = 0; k < c.count; ++k) {
        if (!(c.points[k].normalMass > 0)) continue;
        real t = parabolaTime(c, k, points[k], pair, threshold, context);
        if (t == kNever) continue;
        t = refined(c, c.points[k].anchor, pair, t, threshold, context.h);
        if (t < next.time) next = {t, k};
    }
    return next;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
