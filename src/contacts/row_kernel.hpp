// SPDX-License-Identifier: MIT
// The formulas of a contact's rows, for one contact (T = real) and for several at once (T = Lane): the same
// operations in the same order, so the same bits. Derivation: docs/theory/contacts.md, section 4.
#pragma once

#include "math/lane.hpp"
#include "model/contacts.hpp"
#include "model/motion.hpp"

#include <tamias2d/math/scalar.hpp>
#include <tamias2d/math/vec2.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// One point of a contact, as its Jacobian: what an impulse along the normal or the tangent does to the
/// spins.
template <class T>
struct PointRow {
    T turnA, turnB;          ///< arm x normal    [m]
    T slideA, slideB;        ///< arm x tangent   [m]
    T allowed;               ///< speed at which it may still close   [m/s]
    T normalMass;            ///< inverse of the effective mass along the normal   [1/kg]
    T normalInverse;         ///< 1/normalMass; 0 where there is no point, or nothing gives way   [kg]
    T tangentInverse;        ///< the same along the tangent   [kg]
    T normalImpulse, tangentImpulse;   ///< [N*s]
};

/// A contact of one or two points, ready for the passes.
template <class T>
struct ContactRow {
    BasicVec2<T> normal;     ///< from A to B; the tangent is the normal turned by +90 degrees
    BasicVec2<T> invMassA, invMassB;   ///< [1/kg]
    T invInertiaA, invInertiaB;        ///< [1/(kg*m^2)]
    T friction;              ///< [1]
    T surfaceSpeed;          ///< [m/s]
    T crossMass;             ///< off the diagonal of the two points' 2x2 block   [1/kg]
    T blockInverse;  ///< 1/determinant of that block; 0 where it is singular or half empty   [kg^2]
    T slipMass;  ///< slip per tangent impulse, by the centers alone   [1/kg]
    T slipCoupling;  ///< slip per normal impulse: not 0 where an axis is locked   [1/kg]
    PointRow<T> points[2];
};

/// What steady forces do to a body.
template <class T>
struct SteadyForces {
    BasicVec2<T> carried;  ///< what contacts change its velocity by in a tick   [m/s]
    BasicVec2<T> others;   ///< acceleration by all that is no contact   [m/s^2]
};

/// So much of them is not balanced where a body rests, in whatever direction: rounding, and what the passes
/// leave undone.
inline constexpr real kUnbalanced = real(0.01);

/// The approach along `n` that steady forces make in a tick of length `h`, where B accelerates by `between`
/// against A, and contacts carry `carried` [m/s] of both.   [m/s]
template <class T>
TAMIAS_INLINE T steadyApproach(BasicVec2<T> n, BasicVec2<T> between, T carried, T h)
{
    return h * absolute(dot(n, between)) + carried;
}

/// The same, and at least what of them is not balanced.
template <class T>
TAMIAS_INLINE T steadyApproach(BasicVec2<T> n, const SteadyForces<T>& a, const SteadyForces<T>& b, T h)
{
    const auto whole = [](BasicVec2<T> v) { return absolute(v.x) + absolute(v.y); };
    const BasicVec2<T> between = b.others - a.others;
    const T along = steadyApproach(n, between, absolute(dot(n, a.carried)) + absolute(dot(n, b.carried)), h);
    return maximum(along, T(kUnbalanced) * (h * whole(between) + whole(a.carried) + whole(b.carried)));
}

/// Two impulses that are each >= 0 and bring both residuals to >= 0 (with = 0 where the impulse is > 0): the
/// linear complementarity problem of a two-point contact, solved exactly by its four cases. `r` are the
/// residuals at the impulses `x` at hand, which are replaced. `i1`, `i2` and `i12` are the inverses of the
/// diagonal and of the determinant. Where the last is 0, or where by rounding no case holds, the points are
/// visited one after the other. Exact where nothing needs to change: resting impulses keep their bits.
template <class T>
// NOLINTNEXTLINE(readability-function-size): a symmetric matrix, its inverses and two vectors
TAMIAS_INLINE void solveNormalPair(T k1, T k2, T k12, T i1, T i2, T i12, T r1, T r2, T& x1, T& x2)
{
    const T zero(real(0));
    const T both1 = x1 + (k12 * r2 - k2 * r1) * i12, both2 = x2 + (k12 * r1 - k1 * r2) * i12;
    const T step1 = (k12 * x2 - r1) * i1, step2 = (k12 * x1 - r2) * i2;
    const T only1 = x1 + step1, only2 = x2 + step2;
    const auto regular = i12 > zero;
    const auto both = regular & (both1 >= zero) & (both2 >= zero);
    const auto first = regular & (only1 >= zero) & (r2 + k12 * step1 - k2 * x2 >= zero);
    const auto second = regular & (only2 >= zero) & (r1 + k12 * step2 - k1 * x1 >= zero);
    const auto none = regular & (r1 - k1 * x1 - k12 * x2 >= zero) & (r2 - k12 * x1 - k2 * x2 >= zero);

    const T singly1 = maximum(x1 - r1 * i1, zero);
    const T singly2 = maximum(x2 - (r2 + k12 * (singly1 - x1)) * i2, zero);
    x1 = select(both, both1, select(first, only1, select(second | none, zero, singly1)));
    x2 = select(both, both2, select(first, zero, select(second, only2, select(none, zero, singly2))));
}

/// What the masses and the normal of a row make of an impulse at the centers.
template <class T>
TAMIAS_INLINE T prepareCenters(ContactRow<T>& row)
{
    const BasicVec2<T> n = row.normal, t = perpendicular(n);
    const BasicVec2<T> sum = row.invMassA + row.invMassB;
    row.slipMass = sum.x * t.x * t.x + sum.y * t.y * t.y;
    row.slipCoupling = sum.x * n.x * t.x + sum.y * n.y * t.y;
    return sum.x * n.x * n.x + sum.y * n.y * n.y;
}

/// The Jacobian of one point.
template <class T>
TAMIAS_INLINE void setArms(PointRow<T>& p, BasicVec2<T> n, BasicVec2<T> armA, BasicVec2<T> armB)
{
    const BasicVec2<T> t = perpendicular(n);
    p.turnA = cross(armA, n);
    p.turnB = cross(armB, n);
    p.slideA = cross(armA, t);
    p.slideB = cross(armB, t);
}

/// The same, and its masses. `linear` is what prepareCenters gave; `gap` is beyond the rest
/// gap [m]; `mask` says where there is a point at all. Where nothing gives way no load shows.
template <class T, class Mask>
TAMIAS_INLINE void preparePoint(ContactRow<T>& row, PointRow<T>& p, T linear, BasicVec2<T> armA,
                                BasicVec2<T> armB, T gap, T invH, Mask present)
{
    const T zero(real(0)), one(real(1));
    setArms(p, row.normal, armA, armB);
    p.allowed = select(gap > zero, gap * invH, zero);
    const T k = linear + row.invInertiaA * p.turnA * p.turnA + row.invInertiaB * p.turnB * p.turnB;
    const T kt = row.slipMass + row.invInertiaA * p.slideA * p.slideA + row.invInertiaB * p.slideB * p.slideB;
    const auto pushes = present & (k > zero), rubs = present & (kt > zero);
    p.normalMass = k;
    p.normalInverse = select(pushes, one / k, zero);
    p.tangentInverse = select(rubs, one / kt, zero);
    p.normalImpulse = select(pushes, p.normalImpulse, zero);
    p.tangentImpulse = select(rubs, p.tangentImpulse, zero);
}

/// The 2x2 block of both points.
template <class T>
TAMIAS_INLINE void prepareBlock(ContactRow<T>& row, T linear)
{
    const T zero(real(0));
    const PointRow<T>&p = row.points[0], &q = row.points[1];
    row.crossMass = linear + row.invInertiaA * p.turnA * q.turnA + row.invInertiaB * p.turnB * q.turnB;
    const auto whole = (p.normalInverse > zero) & (q.normalInverse > zero);
    row.crossMass = select(whole, row.crossMass, zero);
    const T determinant = p.normalMass * q.normalMass - row.crossMass * row.crossMass;
    const auto regular = whole & (determinant > T(real(1e-4)) * p.normalMass * q.normalMass);
    row.blockInverse = select(regular, T(real(1)) / determinant, zero);
}

/// Adds an impulse of `normal` along the normal and `tangent` along the tangent at the centers.
template <class T>
TAMIAS_INLINE void applyAtCenters(const ContactRow<T>& row, T normal, T tangent, BasicVec2<T>& a,
                                  BasicVec2<T>& b)
{
    const BasicVec2<T> impulse = normal * row.normal + tangent * perpendicular(row.normal);
    a -= {row.invMassA.x * impulse.x, row.invMassA.y * impulse.y};
    b += {row.invMassB.x * impulse.x, row.invMassB.y * impulse.y};
}

/// What a row carries.
template <class T>
TAMIAS_INLINE BasicContactLoad<T> carriedBy(const ContactRow<T>& row, int count)
{
    const PointRow<T>& p = row.points[0];
    T normal = p.normalImpulse, tangent = p.tangentImpulse;
    T momentA = p.turnA * p.normalImpulse + p.slideA * p.tangentImpulse;
    T momentB = p.turnB * p.normalImpulse + p.slideB * p.tangentImpulse;
    if (count == 2) {
        const PointRow<T>& q = row.points[1];
        normal += q.normalImpulse;
        tangent += q.tangentImpulse;
        momentA += q.turnA * q.normalImpulse + q.slideA * q.tangentImpulse;
        momentB += q.turnB * q.normalImpulse + q.slideB * q.tangentImpulse;
    }
    return {normal * row.normal + tangent * perpendicular(row.normal), momentA, momentB};
}

/// Adds the velocity changes of the impulses the row carries.
template <class T>
TAMIAS_INLINE void addCarried(const ContactRow<T>& row, int count, BodyMotion<T>& a, BodyMotion<T>& b)
{
    const BasicContactLoad<T> load = carriedBy(row, count);
    a.velocity -= {row.invMassA.x * load.impulse.x, row.invMassA.y * load.impulse.y};
    b.velocity += {row.invMassB.x * load.impulse.x, row.invMassB.y * load.impulse.y};
    a.spin -= row.invInertiaA * load.momentA;
    b.spin += row.invInertiaB * load.momentB;
}

/// The arm that setArms was given, but for rounding.   [m]
template <class T>
TAMIAS_INLINE BasicVec2<T> armOf(BasicVec2<T> n, T turn, T slide)
{
    return {slide * n.x + turn * n.y, slide * n.y - turn * n.x};
}

/// How fast a point closes less than it may: negative where it closes too fast.   [m/s]
template <class T>
TAMIAS_INLINE T normalResidual(const PointRow<T>& p, T closing, const BodyMotion<T>& a,
                               const BodyMotion<T>& b)
{
    return closing + p.turnB * b.spin - p.turnA * a.spin + p.allowed;
}

/// Changes of the normal impulses of one pass, and how much they change the normal speeds at most.
template <class T>
struct NormalChange {
    T first, second;  ///< [N*s]
    T speed;  ///< [m/s]
};

/// The normals of one or two points: both as a block. Spins follow at once, the centers with the friction.
template <class T>
TAMIAS_INLINE NormalChange<T> solveNormals(ContactRow<T>& row, int count, BodyMotion<T>& a, BodyMotion<T>& b)
{
    const T zero(real(0));
    const T closing = dot(row.normal, b.velocity - a.velocity);
    PointRow<T>& p = row.points[0];
    const T r1 = normalResidual(p, closing, a, b);
    if (count == 1) {
        const T total = maximum(p.normalImpulse - r1 * p.normalInverse, zero);
        const T change = total - p.normalImpulse;
        p.normalImpulse = total;
        a.spin -= row.invInertiaA * (p.turnA * change);
        b.spin += row.invInertiaB * (p.turnB * change);
        return {change, zero, absolute(p.normalMass * change)};
    }
    PointRow<T>& q = row.points[1];
    const T r2 = normalResidual(q, closing, a, b);
    const T old1 = p.normalImpulse, old2 = q.normalImpulse;
    solveNormalPair(p.normalMass, q.normalMass, row.crossMass, p.normalInverse, q.normalInverse,
                    row.blockInverse, r1, r2, p.normalImpulse, q.normalImpulse);
    const T d1 = p.normalImpulse - old1, d2 = q.normalImpulse - old2;
    a.spin -= row.invInertiaA * (p.turnA * d1 + q.turnA * d2);
    b.spin += row.invInertiaB * (p.turnB * d1 + q.turnB * d2);
    return {d1, d2,
            maximum(absolute(p.normalMass * d1 + row.crossMass * d2),
                    absolute(row.crossMass * d1 + q.normalMass * d2))};
}

/// Coulomb's friction at one point, on the slip [m/s] of the centers that the normal impulses left.
template <class T>
TAMIAS_INLINE T solveFriction(const ContactRow<T>& row, PointRow<T>& p, T slip, BodyMotion<T>& a,
                              BodyMotion<T>& b)
{
    const T limit = row.friction * p.normalImpulse;
    const T here = slip + p.slideB * b.spin - p.slideA * a.spin;
    const T total = clamp(p.tangentImpulse - here * p.tangentInverse, -limit, limit);
    const T change = total - p.tangentImpulse;
    p.tangentImpulse = total;
    a.spin -= row.invInertiaA * (p.slideA * change);
    b.spin += row.invInertiaB * (p.slideB * change);
    return change;
}

/// Friction of all points after the normals changed by `change`; then the centers get both.
template <class T>
TAMIAS_INLINE void solveFrictions(ContactRow<T>& row, int count, NormalChange<T> change, BodyMotion<T>& a,
                                  BodyMotion<T>& b)
{
    T normal = change.first;
    if (count == 2) normal += change.second;
    T slip = dot(perpendicular(row.normal), b.velocity - a.velocity) + row.surfaceSpeed +
             row.slipCoupling * normal;
    T tangent = solveFriction(row, row.points[0], slip, a, b);
    if (count == 2) {
        slip += row.slipMass * tangent;
        tangent += solveFriction(row, row.points[1], slip, a, b);
    }
    applyAtCenters(row, normal, tangent, a.velocity, b.velocity);
}

/// By how much a body has got another motion: the center along an axis, or a point so far from it by the
/// spin.   [m/s]
template <class T>
TAMIAS_INLINE T changeBetween(const BodyMotion<T>& before, const BodyMotion<T>& after, T arm)
{
    const BasicVec2<T> by = after.velocity - before.velocity;
    return maximum(maximum(absolute(by.x), absolute(by.y)), arm * absolute(after.spin - before.spin));
}

/// One pass: normals, then friction. Returns the greatest change of normal speed it made.   [m/s]
template <class T>
TAMIAS_INLINE T solveRow(ContactRow<T>& row, int count, BodyMotion<T>& a, BodyMotion<T>& b)
{
    const NormalChange<T> change = solveNormals(row, count, a, b);
    solveFrictions(row, count, change, a, b);
    return change.speed;
}

/// A change held to a bound; 0 for what is no number, as the sum of two infinite loads.
template <class T>
TAMIAS_INLINE T limitedChange(T change, T bound)
{
    return select(isEqual(change, change), clamp(change, -bound, bound), T(real(0)));
}

/// What pushing asks of a point that is `off` beyond the slack it leaves to the rest gap: to undo a part of
/// an overlap, no faster than `most`, and to use up no more than what is free.   [m/s]
template <class T>
TAMIAS_INLINE T pushBias(T off, T invH, T rate, T most)
{
    return select(off > T(real(0)), off * invH, maximum(rate * off * invH, -most));
}

/// One pass of displacements that undo overlaps: velocities over one tick that move bodies and no more.
/// `bias` is the speed asked for at each point [m/s]. Returns the sum of the impulses [N*s].
template <class T>
TAMIAS_INLINE T pushRow(const ContactRow<T>& row, int count, T bias1, T bias2, BodyMotion<T>& a,
                        BodyMotion<T>& b)
{
    const T zero(real(0));
    const T closing = dot(row.normal, b.velocity - a.velocity);
    const PointRow<T>&p = row.points[0], &q = row.points[1];
    T x1 = zero, x2 = zero;
    const T r1 = closing + p.turnB * b.spin - p.turnA * a.spin + bias1;
    if (count == 1) {
        x1 = maximum(x1 - r1 * p.normalInverse, zero);
        a.spin -= row.invInertiaA * (p.turnA * x1);
        b.spin += row.invInertiaB * (p.turnB * x1);
    } else {
        const T r2 = closing + q.turnB * b.spin - q.turnA * a.spin + bias2;
        solveNormalPair(p.normalMass, q.normalMass, row.crossMass, p.normalInverse, q.normalInverse,
                        row.blockInverse, r1, r2, x1, x2);
        a.spin -= row.invInertiaA * (p.turnA * x1 + q.turnA * x2);
        b.spin += row.invInertiaB * (p.turnB * x1 + q.turnB * x2);
    }
    const T sum = count == 1 ? x1 : x1 + x2;
    applyAtCenters(row, sum, zero, a.velocity, b.velocity);
    return sum;
}

/// Takes back the angular momentum that a push over a time `h` gave two bodies that slide along each other,
/// by opposite impulses at their centers, `d` apart: farther apart, they pass more slowly [GD1]. Only where
/// they press on each other: two that meet in flight keep their energy to the last digit instead. No push
/// counts for more than that distance, as pushes of bodies that lie in each other may. Returns the impulse on
/// B [N*s].
template <class T>
TAMIAS_INLINE BasicVec2<T> repayPush(const ContactRow<T>& row, T pushed, T load, BasicVec2<T> d, T h,
                                     BasicVec2<T>& velocityA, BasicVec2<T>& velocityB)
{
    const T zero(real(0));
    const auto isFree = [zero](BasicVec2<T> m) { return (m.x > zero) & (m.x >= m.y) & (m.y >= m.x); };
    const T squared = dot(d, d);
    const auto owes =
        isFree(row.invMassA) & isFree(row.invMassB) & (pushed > zero) & (load > zero) & (squared > zero);
    const T inverse = row.invMassA.x + row.invMassB.x, way = h * pushed * inverse;
    const T moment = select(way * way > squared, squareRoot(squared) / inverse, h * pushed);  // [kg*m]
    const T gained = moment * cross(row.normal, velocityB - velocityA);
    const BasicVec2<T> impulse = select(owes, -gained / squared, zero) * perpendicular(d);
    velocityA -= {row.invMassA.x * impulse.x, row.invMassA.y * impulse.y};
    velocityB += {row.invMassB.x * impulse.x, row.invMassB.y * impulse.y};
    return impulse;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
