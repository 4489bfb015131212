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
    flight.extent = m.extent;
    if (!m.moves()) return flight;
    flight.acceleration = expectedAcceleration(m, invH);
    flight.spinRate = expectedSpinRate(m, invH);
    return flight;
}

Trajectory pathOf(const Motion& m, const Flight& f, Position origin, real invH)
{
    Trajectory path = predictedPath(m, origin, invH);
    path.position += f.offset;
    path.angle += static_cast<double>(f.turned);
    if (f.turned != 0) path.rotation = Rot::ofAngle(path.angle);
    path.velocity = f.velocity;
    path.spin = f.spin;
    return path;
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

bool isPlainPoint(const Contact& contact, int k)
{
    return !contact.atImpact && !normalTurns(contact, contact.points[k].anchor);
}

ImpactPoint turnedImpactPoint(const Contact& contact, int k, const FlyingPair& pair)
{
    const real t = contact.atImpact ? contact.time : pair.start();
    const Moment at = momentAt(contact, contact.points[k].anchor, pair, t);
    ImpactPoint point{at.normal, cross(at.place.armA, at.normal), cross(at.place.armB, at.normal),
                      at.place.gap};
    point.gap -= dot(point.normal, pair.flightB.shiftAt(t) - pair.flightA.shiftAt(t)) +
                 point.turnB * pair.flightB.turnAt(t) - point.turnA * pair.flightA.turnAt(t);
    return point;
}

ImpactPoint impactPoint(const Contact& contact, int k, const FlyingPair& pair)
{
    const ContactPointRow& row = contact.points[k];
    const Vec2 n = contact.normal;
    ImpactPoint point = isPlainPoint(contact, k)
                            ? ImpactPoint{n, cross(row.armA, n), cross(row.armB, n), row.gap}
                            : turnedImpactPoint(contact, k, pair);
    point.yields = row.normalMass > 0;
    return point;
}

real closingTime(real gap, real rate, real bend)
{
    if (!(gap > 0)) return 0;
    const real discriminant = rate * rate - 2 * bend * gap;
    if (!(discriminant >= 0)) return kNever;
    const real root = std::sqrt(discriminant);
    if (rate < 0) return 2 * gap / (root - rate);
    return bend < 0 ? (-rate - root) / bend : kNever;
}

namespace {

// When the point's gap, a parabola in time, first reaches zero while closing fast enough.
real parabolaTime(const Contact& c, int k, const ImpactPoint& point, const Closing& closing,
                  const FlyingPair& pair, real threshold, const StepContext& context)
{
    const Flight &fa = pair.flightA, &fb = pair.flightB;
    const Vec2 n = point.normal;
    const auto [speed, push, offset] = closing;

    const real start = pair.start();
    real gap = point.gap + offset + speed * start + push * start * start / 2, rate = speed + push * start;

    // Anchors of a turning body run on circles: counts for the time, not for the speed. They have turned
    // since the point was placed: with the two at the start of the search, else at the start of the tick.
    real bend = push;
    const bool turns = (absolute(fa.spin) + absolute(fb.spin)) * context.h >= real(0.05);
    if (turns && !c.atImpact) {
        const real coreA = dot(n, rotate(pair.a.rotation, c.points[k].anchor.localA));
        const real coreB = dot(n, rotate(pair.b.rotation, c.points[k].anchor.localB));
        bend += fa.spin * fa.spin * coreA - fb.spin * fb.spin * coreB;
        if (!normalTurns(c, c.points[k].anchor)) {
            const real turnedA = fa.turnAt(start), turnedB = fb.turnAt(start);
            gap += (turnedA * turnedA * coreA - turnedB * turnedB * coreB) / 2;
            rate += turnedA * fa.spin * coreA - turnedB * fb.spin * coreB;
        }
    }

    const real t = start + closingTime(gap, rate, bend);
    if (!(t <= context.h)) return kNever;
    return closing.at(t) < -threshold ? t : kNever;
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

namespace {

// How far B went against A along an axis by time `t`, and by how much both turned.
struct Went {
    real along, turned, rounding;

    Went(Vec2 axis, const Flight& a, const Flight& b, real t)
    {
        const Vec2 shift = b.shiftAt(t) - a.shiftAt(t);
        along = dot(axis, shift);
        turned = real(1.001) * (a.extent * absolute(a.turnAt(t)) + b.extent * absolute(b.turnAt(t)));
        rounding = real(0.001) * (absolute(shift.x) + absolute(shift.y));
    }
};

}  // namespace

Apart apartAt(real start, const Apart& apart, const Flight& a, const Flight& b)
{
    const Went went(apart.axis, a, b, start);
    return {apart.axis, apart.gap + went.along - went.turned - went.rounding};
}

Apart apartBefore(real start, const Apart& apart, const Flight& a, const Flight& b)
{
    const Went went(apart.axis, a, b, start);
    return {apart.axis, apart.gap - went.along - went.turned - went.rounding};
}

real approachWithin(Vec2 axis, const Flight& a, const Flight& b, real from, real to)
{
    const real span = to - from;
    const real first = dot(axis, b.velocity - a.velocity), rate = dot(axis, b.acceleration - a.acceleration);
    const real slowest = minimum(first + from * rate, first + to * rate);
    const real turning = a.extent * (absolute(a.spin) + to * absolute(a.spinRate)) +
                         b.extent * (absolute(b.spin) + to * absolute(b.spinRate));
    return real(1.001) * span * (maximum(-slowest, real(0)) + turning);
}

namespace {

// What impacts of this tick have left of an approach is not the work of steady forces; but there is an end to
// it, as friction at an impact may turn the bodies on towards each other by ever less.
real slowestImpact(const Contact& c, const FlyingPair& pair, const StepContext& context)
{
    const real threshold = impactThreshold(c, pair.a, pair.b, context);
    return c.impacts > 0 ? maximum(threshold / 3, real(1e-4) * c.fastestImpact) : threshold;
}

}  // namespace

Impact nextImpact(const Contact& c, const ImpactPoint points[2], const FlyingPair& pair,
                  const StepContext& context)
{
    Impact next;
    if (c.impacts >= mostImpacts(c, context)) return next;
    const real slowest = leastApproach(c, context);
    real threshold = -1;
    for (int k = 0; k < c.count; ++k) {
        if (!points[k].yields) continue;
        // Rates are linear in time: where neither end is fast enough, nothing between them is.
        const Closing closing(points[k], pair.flightA, pair.flightB);
        if (!(closing.at(pair.start()) < -slowest) && !(closing.at(context.h) < -slowest)) continue;
        if (threshold < 0) threshold = maximum(slowestImpact(c, pair, context), slowest);
        real t = parabolaTime(c, k, points[k], closing, pair, threshold, context);
        if (t == kNever) continue;
        t = refined(c, c.points[k].anchor, pair, t, threshold, context.h);
        if (t < next.time) next = {t, k};
    }
    return next;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
