// SPDX-License-Identifier: MIT
// What an impact does: the impulse of DD8 at one point or at two at once, then Coulomb's; given to the
// bodies as two kicks, before and after the drift. docs/theory/contacts.md, section 3.

#include "solver/impact_response.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

ImpactRecord recordOf(const Contact& c, const Moment& before, Position centerA)
{
    ImpactRecord entry{};
    entry.shapeA = c.shapeA;
    entry.shapeB = c.shapeB;
    HitEvent& hit = entry.hit;
    hit.point = centerA + toDVec2(before.place.armA);
    hit.normal = before.normal;
    hit.armA = before.place.armA;
    hit.armB = before.place.armB;
    hit.approachSpeed = -before.normalSpeed();
    hit.velocityA = before.velocityA;
    hit.velocityB = before.velocityB;
    hit.angularVelocityA = before.spinA;
    hit.angularVelocityB = before.spinB;
    return entry;
}

void ImpactResponse::applyAt(const Contact& c, const PlacedPoint& place, Vec2 impulse, real t)
{
    const real late = t * context_.invH, early = 1 - late;
    const auto hit = [&](std::uint32_t row, Vec2 arm, Vec2 given) {
        const Motion& m = motion(row);
        if (!m.moves()) return;
        Flight& f = flights_[row];
        ImpactKick& kick = stage_.rows.kicks[row];
        const Vec2 dv{m.invMass.x * given.x, m.invMass.y * given.y};
        const real dw = m.invInertia * cross(arm, given);
        f.velocity += dv;
        f.spin += dw;
        f.offset -= t * dv;
        f.turned -= t * dw;
        kick.before += early * dv;
        kick.after += late * dv;
        kick.spinBefore += early * dw;
        kick.spinAfter += late * dw;
        f.clock = t;
        f.strayed += (context_.h - t) * (length(dv) + f.extent * absolute(dw));
    };
    hit(c.rowA, place.armA, -impulse);
    hit(c.rowB, place.armB, impulse);
}

// Friction acts on the slip that the normal impulse leaves: the other order raises energy [ADR16].
real ImpactResponse::frictionImpulse(Contact& c, const Moment& moment, real normalImpulse, real t)
{
    if (!(c.friction > 0)) return 0;
    const Vec2 tangent = perpendicular(moment.normal);
    const real mass = compliance(motion(c.rowA), moment.place.armA, tangent) +
                      compliance(motion(c.rowB), moment.place.armB, tangent);
    if (!(mass > 0)) return 0;
    const Flight &fa = flights_[c.rowA], &fb = flights_[c.rowB];
    const Vec2 vA = fa.velocity + t * fa.acceleration, vB = fb.velocity + t * fb.acceleration;
    const real wA = fa.spin + t * fa.spinRate, wB = fb.spin + t * fb.spinRate;
    const real slip =
        dot(tangent, vB + cross(wB, moment.place.armB) - vA - cross(wA, moment.place.armA)) + c.surfaceSpeed;
    const real impulse = clamp(-slip / mass, -c.friction * normalImpulse, c.friction * normalImpulse);
    applyAt(c, moment.place, impulse * tangent, t);
    return impulse;
}

void ImpactResponse::record(Contact& c, const Moment& before, real normalImpulse, real tangentImpulse, real t,
                            real restitution)
{
    ImpactRecord entry = recordOf(c, before, motion(c.rowA).center + toDVec2(flights_[c.rowA].shiftAt(t)));
    entry.number = static_cast<std::uint32_t>(stage_.records.size());
    HitEvent& hit = entry.hit;
    hit.time = context_.time + static_cast<double>(tickStart_) + static_cast<double>(t);
    c.fastestImpact = maximum(c.fastestImpact, hit.approachSpeed);
    hit.restitution = restitution;
    hit.normalImpulse = normalImpulse;
    hit.tangentImpulse = tangentImpulse;
    hit.group = stage_.groups;
    c.stepImpulse += normalImpulse * before.normal + tangentImpulse * perpendicular(before.normal);
    stage_.records.push_back(entry);
}

// DD8 at one point, then Coulomb.
void ImpactResponse::actOnOne(Contact& c, int k, real t, real restitution)
{
    const Moment moment = momentAt(c, c.points[k].anchor, pairOf(c), t);
    const real mass = compliance(motion(c.rowA), moment.place.armA, moment.normal) +
                      compliance(motion(c.rowB), moment.place.armB, moment.normal);
    if (!(mass > 0)) return;
    const real impulse = -(1 + restitution) * moment.normalSpeed() / mass;
    applyAt(c, moment.place, impulse * moment.normal, t);
    const real friction = frictionImpulse(c, moment, impulse, t);
    c.points[k].stepNormal += impulse;
    c.points[k].stepTangent += friction;
    record(c, moment, impulse, friction, t, restitution);
}

// Two points that close at once: both normal speeds are reversed together, which keeps the energy
// of an elastic flat landing. False if only one of them takes part.
bool ImpactResponse::actOnBoth(Contact& c, int first, real t, real restitution)
{
    const int second = 1 - first;
    const FlyingPair pair = pairOf(c);
    const Moment one = momentAt(c, c.points[first].anchor, pair, t);
    const Moment two = momentAt(c, c.points[second].anchor, pair, t);
    const real v1 = dot(c.normal, one.relative()), v2 = dot(c.normal, two.relative());
    if (!(two.place.gap < real(0.05) * c.restGap) || !(v2 < 0) || !(v1 < 0)) return false;

    const Motion &a = motion(c.rowA), &b = motion(c.rowB);
    const Vec2 n = c.normal;
    const real k1 = compliance(a, one.place.armA, n) + compliance(b, one.place.armB, n);
    const real k2 = compliance(a, two.place.armA, n) + compliance(b, two.place.armB, n);
    const real k12 = crossCompliance(a, b, n, one.place.armA, one.place.armB, two.place.armA, two.place.armB);
    // One of the two may have no part in it: the first one hit then turns the body off the other.
    const real b1 = -(1 + restitution) * v1, b2 = -(1 + restitution) * v2;
    const real determinant = k1 * k2 - k12 * k12;
    if (!(k1 > 0) || !(k2 > 0) || !(determinant > real(1e-4) * k1 * k2)) return false;
    real j1 = 0, j2 = 0;
    solveNormalPair(k1, k2, k12, 1 / k1, 1 / k2, 1 / determinant, -b1, -b2, j1, j2);

    if (j1 > 0) applyAt(c, one.place, j1 * n, t);
    if (j2 > 0) applyAt(c, two.place, j2 * n, t);
    const real f1 = j1 > 0 ? frictionImpulse(c, one, j1, t) : real(0);
    const real f2 = j2 > 0 ? frictionImpulse(c, two, j2, t) : real(0);
    c.points[first].stepNormal += j1;
    c.points[first].stepTangent += f1;
    c.points[second].stepNormal += j2;
    c.points[second].stepTangent += f2;
    if (j1 > 0) record(c, one, j1, f1, t, restitution);
    if (j2 > 0) record(c, two, j2, f2, t, restitution);
    return true;
}

void ImpactResponse::act(Contact& c, const Impact& impact)
{
    // A crowded tick ends plastic, so that it ends.
    ++c.impacts;
    const real restitution = c.impacts > mostImpacts(c, context_) / 2 ? real(0) : c.restitution;
    if (c.impacts == context_.tuning.impactsPerContact) ++stage_.clamps.impactsPerContact;

    ++stage_.groups;
    if (c.count < 2 || !actOnBoth(c, impact.point, impact.time, restitution))
        actOnOne(c, impact.point, impact.time, restitution);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
