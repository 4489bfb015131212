// SPDX-License-Identifier: MIT
#pragma once

#include "joints/kinds.hpp"
#include "model/bodies.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where a body is, or is expected to be.
struct BodyPlace {
    Position center;     // [m]
    double angle = 0;    // [rad]
    Rot rotation;
};

inline BodyPlace placeOf(const Motion& m)
{
    return {m.center, m.angle, m.rotation};
}

/// After a drift over `h` at a velocity.
BodyPlace placeAhead(const Motion& m, const BodyMotion<real>& velocity, real h);

/// The angle of B against A nearest to `near`: so turns are counted.   [rad]
double countTurns(double angleA, double angleB, double near);

/// What a joint remembers of angles as it begins, or begins anew: turns, and the tooth of a ratchet.
void beginCount(JointRow& joint, double angleA, double angleB);

/// The same for angles that follow those before.
void followCount(JointRow& joint, double angleA, double angleB);

/// Do the counts of one kind go on as those of another?
bool countsAlike(const JointKind& one, const JointKind& other);

/// What the joint sees of its bodies there. `turned` is the angle of B against A, turns counted.
JointPose poseOf(const JointRow& joint, const BodyTable& bodies, const Motion& a, const Motion& b,
                 const BodyPlace& placeA, const BodyPlace& placeB, double turned);

}  // namespace tamias2d::inline TAMIAS_PRECISION
