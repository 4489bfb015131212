// SPDX-License-Identifier: MIT
// How an impulse along one row moves another.
#pragma once

#include "joints/rows.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

inline real complianceAlong(const Jacobian& j, const Jacobian& k, const Motion& a, const Motion& b)
{
    return a.invMass.x * j.linearA.x * k.linearA.x + a.invMass.y * j.linearA.y * k.linearA.y +
           a.invInertia * j.turnA * k.turnA + b.invMass.x * j.linearB.x * k.linearB.x +
           b.invMass.y * j.linearB.y * k.linearB.y + b.invInertia * j.turnB * k.turnB;
}

/// What a body beyond two adds to that.
inline real complianceOf(const MoreBodies& more, int i, int k, int body, const Motion& m)
{
    const ConstraintRows::Part &p = more.parts[i][body], &q = more.parts[k][body];
    return m.invMass.x * p.linear.x * q.linear.x + m.invMass.y * p.linear.y * q.linear.y +
           m.invInertia * p.turn * q.turn;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
