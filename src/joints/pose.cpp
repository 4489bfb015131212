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

void beginCount(JointRow& joint, double angleA, double angleB)
{
    const JointFrames frames = framesOf(joint.def.kind);
    double near = frames.reference;
    joint.angleA = 0;
    if (const auto* gear = std::get_if<GearJoint>(&joint.def.kind)) {
        joint.angleA = angleA;
        near = (static_cast<double>(gear->ratio) - 1) * angleA + gear->phase;
    }
    joint.angle = countTurns(angleA, angleB, countTurns(angleA, angleB, near) + kTwoPi * frames.turns);
    joint.notch = 0;
    if (const auto* ratchet = std::get_if<RatchetJoint>(&joint.def.kind))
        joint.notch = toothAt(*ratchet, joint.angle - ratchet->referenceAngle);
}

void followCount(JointRow& joint, double angleA, double angleB)
{
    joint.angle = countTurns(angleA, angleB, joint.angle);
    if (std::holds_alternative<GearJoint>(joint.def.kind)) joint.angleA = countTurns(0, angleA, joint.angleA);
    if (const auto* ratchet = std::get_if<RatchetJoint>(&joint.def.kind))
        joint.notch = maximum(joint.notch, toothAt(*ratchet, joint.angle - ratchet->referenceAngle));
}

bool countsAlike(const JointKind& one, const JointKind& other)
{
    if (const auto* gear = std::get_if<GearJoint>(&one)) {
        const auto* second = std::get_if<GearJoint>(&other);
        return second && gear->ratio == second->ratio;
    }
    if (std::holds_alternative<RatchetJoint>(one)) return one == other;
    return framesOf(one).turns == framesOf(other).turns;
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
    if (std::holds_alternative<GearJoint>(joint.def.kind))
        pose.angleA = countTurns(0, a.angle, joint.angleA) + (placeA.angle - a.angle);
    if (const auto* pulley = std::get_if<PulleyJoint>(&joint.def.kind)) {
        pose.hangA = toVec2(placeA.center - pulley->wheelA) + pose.armA;
        pose.hangB = toVec2(placeB.center - pulley->wheelB) + pose.armB;
    }
    pose.notch = joint.notch;
    pose.mass = reducedOf(a.greatestInvMass(), b.greatestInvMass());
    pose.inertia = reducedOf(a.invInertia, b.invInertia);
    return pose;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
