// SPDX-License-Identifier: MIT
// The formulas of a contact's rows, for one contact (T = real) and for several at once (T = Lane): the same
// operations in the same order, so the same bits. Derivation: docs/theory/contacts.md, section 4.
//
// A Body has velocity, spin, invMass and invInertia; a Point has armA, armB, normalMass, tangentMass,
// normalImpulse and tangentImpulse; a contact (Row) has normal, crossMass, friction, surfaceSpeed and points.
#pragma once

#include "math/lane.hpp"

#include <tamias2d/math/scalar.hpp>
#include <tamias2d/math/vec2.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Applies an impulse to B at its arm, and its opposite to A [T2].
template <class Body, class T>
void applyImpulse(Body& a, Body& b, BasicVec2<T> armA, BasicVec2<T> armB, BasicVec2<T> impulse)
{
    a.velocity -= {a.invMass.x * impulse.x, a.invMass.y * impulse.y};
    a.spin -= a.invInertia * cross(armA, impulse);
    b.velocity += {b.invMass.x * impulse.x, b.invMass.y * impulse.y};
    b.spin += b.invInertia * cross(armB, impulse);
}

/// Velocity of B against A at the point.   [m/s]
template <class Point, class Body>
auto relativeVelocity(const Point& point, const Body& a, const Body& b)
{
    return (b.velocity + cross(b.spin, point.armB)) - (a.velocity + cross(a.spin, point.armA));
}

/// Two impulses that are each >= 0 and bring both residuals to >= 0 (with = 0 where the impulse is
/// > 0): the linear complementarity problem of a two-point contact, solved exactly by its four cases.
/// `r` are the residuals at zero impulse. False where the block is too near to singular, or
/// where by rounding no case holds: then the points are visited singly.
template <class T>
auto solveBlock(T k1, T k2, T k12, T r1, T r2, T& x1, T& x2)
{
    const T zero(real(0));
    const T determinant = k1 * k2 - k12 * k12;
    const T both1 = (k12 * r2 - k2 * r1) / determinant, both2 = (k12 * r1 - k1 * r2) / determinant;
    const T only1 = -r1 / k1, only2 = -r2 / k2;
    const auto both = (both1 >= zero) & (both2 >= zero);
    const auto first = (only1 >= zero) & (r2 + k12 * only1 >= zero);
    const auto second = (only2 >= zero) & (r1 + k12 * only2 >= zero);
    const auto none = (r1 >= zero) & (r2 >= zero);
    x1 = select(both, both1, select(first, only1, zero));
    x2 = select(both, both2, select(first, zero, select(second, only2, zero)));
    return (determinant > T(real(1e-4)) * k1 * k2) & (both | first | second | none);
}

/// Both normals at once. `allowed` is the speed at which each may still close [m/s]. Returns the greatest
/// change of normal speed it made; nothing is changed where `solved` comes back false.
template <class Row, class Body, class T, class Mask>
T solveNormalsAsBlock(Row& row, Body& a, Body& b, T allowed1, T allowed2, Mask& solved)
{
    auto &p = row.points[0], &q = row.points[1];
    const BasicVec2<T> n = row.normal;
    const T k12 = row.crossMass;
    const T r1 =
        dot(n, relativeVelocity(p, a, b)) + allowed1 - p.normalMass * p.normalImpulse - k12 * q.normalImpulse;
    const T r2 =
        dot(n, relativeVelocity(q, a, b)) + allowed2 - k12 * p.normalImpulse - q.normalMass * q.normalImpulse;
    T x1, x2;
    solved = solveBlock(p.normalMass, q.normalMass, k12, r1, r2, x1, x2);
    x1 = select(solved, x1, p.normalImpulse);
    x2 = select(solved, x2, q.normalImpulse);

    const T d1 = x1 - p.normalImpulse, d2 = x2 - q.normalImpulse;
    applyImpulse(a, b, p.armA, p.armB, d1 * n);
    applyImpulse(a, b, q.armA, q.armB, d2 * n);
    p.normalImpulse = x1;
    q.normalImpulse = x2;
    return maximum(absolute(p.normalMass * d1 + k12 * d2), absolute(k12 * d1 + q.normalMass * d2));
}

/// One normal. Contacts push and never pull: it is the running total that stays non-negative.
template <class Row, class Point, class Body, class T>
T solveNormal(const Row& row, Point& point, Body& a, Body& b, T allowed)
{
    const BasicVec2<T> n = row.normal;
    const T normalSpeed = dot(n, relativeVelocity(point, a, b));
    const T wanted = point.normalImpulse - (normalSpeed + allowed) / point.normalMass;
    const T total = maximum(wanted, T(real(0)));
    const T change = total - point.normalImpulse;
    applyImpulse(a, b, point.armA, point.armB, change * n);
    point.normalImpulse = total;
    return absolute(change * point.normalMass);
}

/// Coulomb's friction at one point, on the slip that the normal impulses left.
template <class Row, class Point, class Body>
void solveFriction(const Row& row, Point& point, Body& a, Body& b)
{
    const auto t = perpendicular(row.normal);
    const auto slip = dot(t, relativeVelocity(point, a, b)) + row.surfaceSpeed;
    const auto limit = row.friction * point.normalImpulse;
    const auto total = clamp(point.tangentImpulse - slip / point.tangentMass, -limit, limit);
    applyImpulse(a, b, point.armA, point.armB, (total - point.tangentImpulse) * t);
    point.tangentImpulse = total;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
