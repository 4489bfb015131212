// SPDX-License-Identifier: MIT
#include "joints/pose.hpp"

#include <tamias2d/math/scalar.hpp>

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Of two on a spring: one mass against a wall is itself, two equal ones are half of one.
real reducedOf(real inverseA, real inverseB)
{
    const real sum = inverseA + inverseB;
    return sum > 0 ? 1 / sum : real(0);
}

}  // namespace

BodyPlace placeAhead(const Motion& m, const BodyMotion<real>& velocity, real h)
{
    const double time = static_cast<double>(h);
    const double turn = time * static_cast<double>(velocity.spin) + m.excessTurn;
    return {m.center + (time * toDVec2(velocity.velocity) + m.excess), m.angle + turn,
            turn != 0 ? Rot::ofAngle(wrapAngle(m.angle + turn)) : m.rotation};
}

double countTurns(double angleA, double angleB, double near)
{
    const double angle = angleB - angleA;
    return angle + kTwoPi * std::floor((near - angle) / kTwoPi + 0.5);
}

JointPose poseOf(const JointRow& joint, const BodyTable& bodies, const Motion& a, const Motion& b,
                 const BodyPlace& placeA, const BodyPlace& placeB, double turned)
{
    const JointFrames frames = framesOf(joint.def.kind);
    JointPose pose;
    pose.rotationA = placeA.rotation;
    pose.armB = rotate(placeB.rotation, frames.anchorB - bodies.rows[joint.bodyB].localCenter);
    if (frames.place) {
        pose.armA = toVec2(*frames.place - placeA.center);
        pose.between = toVec2(placeB.center - *frames.place) + pose.armB;
    } else {
        pose.armA = rotate(placeA.rotation, frames.anchorA - bodies.rows[joint.bodyA].localCenter);
        pose.between = toVec2(placeB.center - placeA.center) + pose.armB - pose.armA;
    }
    pose.angle = frames.absolute ? countTurns(frames.reference, placeB.angle, 0) : turned - frames.reference;
    pose.mass = reducedOf(maximum(a.invMass.x, a.invMass.y), maximum(b.invMass.x, b.invMass.y));
    pose.inertia = reducedOf(a.invInertia, b.invInertia);
    return pose;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
