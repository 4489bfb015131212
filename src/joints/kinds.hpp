// SPDX-License-Identifier: MIT
// The kinds of joints: each says where it holds its bodies, and what rows it has there.
#pragma once

#include "joints/rows.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// A kind of joint that may have a motor.
template <class Kind>
concept HasMotor = requires(Kind k) { k.motor->speed; };

/// Where the two bodies of a joint are, or are expected to be.
struct JointPose {
    Vec2 armA, armB;          // from the centers of mass to the anchors   [m]
    Vec2 between;             // from A's anchor to B's                    [m]
    Rot rotationA;
    Vec2 hangA, hangB;        // from the wheels of a pulley to the anchors   [m]
    double angle = 0;         // of B against A, reference taken off, turns counted   [rad]
    double angleA = 0;        // of a gear: of A itself, turns counted   [rad]
    double notch = 0;         // of a ratchet: the tooth it may not go back from
    real mass = 0;            // of the two on a spring between them       [kg]
    real inertia = 0;         // likewise, about their centers             [kg*m^2]
};

/// What a kind holds its bodies by: points of their frames, and the angle that counts as 0. A target has a
/// place in the world instead of a point of A.
struct JointFrames {
    Vec2 anchorA, anchorB;    // [m]
    double reference = 0;     // [rad]
    const Position* place = nullptr;
    bool absolute = false;    // the angle is B's own, by the shorter way
    int turns = 0;            // whole ones that the angle begins with
};

JointFrames framesOf(const JointKind& kind);

/// What a reading calls the joint's position.
struct JointCoordinate {
    double position = 0;      // [m] or [rad]
    Jacobian j;
};

// One of each for every kind, in a file of its name: the rows at a pose, rigid ones first.
void measure(const RevoluteJoint& kind, const JointPose& pose, JointRows& out);
void measure(const DistanceJoint& kind, const JointPose& pose, JointRows& out);
void measure(const PrismaticJoint& kind, const JointPose& pose, JointRows& out);
void measure(const WeldJoint& kind, const JointPose& pose, JointRows& out);
void measure(const TargetJoint& kind, const JointPose& pose, JointRows& out);
void measure(const WheelJoint& kind, const JointPose& pose, JointRows& out);
void measure(const GrooveJoint& kind, const JointPose& pose, JointRows& out);
void measure(const RotaryJoint& kind, const JointPose& pose, JointRows& out);
void measure(const RatchetJoint& kind, const JointPose& pose, JointRows& out);
void measure(const GearJoint& kind, const JointPose& pose, JointRows& out);
void measure(const RackJoint& kind, const JointPose& pose, JointRows& out);
void measure(const PulleyJoint& kind, const JointPose& pose, JointRows& out);
void measure(const MotorJoint& kind, const JointPose& pose, JointRows& out);
void measure(const FrictionJoint& kind, const JointPose& pose, JointRows& out);
inline void measure(const FilterJoint&, const JointPose&, JointRows&) {}
inline void measure(const OwnJoint&, const JointPose&, JointRows&) {}  // own.hpp

JointCoordinate coordinateOf(const RevoluteJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const DistanceJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const PrismaticJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const WeldJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const TargetJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const WheelJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const GrooveJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const RotaryJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const RatchetJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const GearJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const RackJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const PulleyJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const MotorJoint& kind, const JointPose& pose);
JointCoordinate coordinateOf(const FrictionJoint& kind, const JointPose& pose);
inline JointCoordinate coordinateOf(const FilterJoint&, const JointPose&)
{
    return {};
}
inline JointCoordinate coordinateOf(const OwnJoint&, const JointPose&)
{
    return {};
}

/// The number of the last tooth passed at an angle [rad].
double toothAt(const RatchetJoint& kind, double angle);

inline void measureJoint(const JointKind& kind, const JointPose& pose, JointRows& out)
{
    out.count = out.rigid = 0;
    out.distance = 0;
    out.armA = pose.armA;
    out.armB = pose.armB;
    std::visit([&](const auto& k) { measure(k, pose, out); }, kind);
}

// --- what kinds are made of

/// A direction given in A's frame, of length 1, in the world.
Vec2 axisIn(Vec2 given, const JointPose& pose);

/// Moves the points of the two bodies apart along `n`.
inline Jacobian pointJacobian(Vec2 n, const JointPose& pose)
{
    return {-n, n, -cross(pose.armA, n), cross(pose.armB, n)};
}

/// The same for an `n` that is fixed in A.
inline Jacobian slideJacobian(Vec2 n, const JointPose& pose)
{
    return {-n, n, -cross(pose.armA + pose.between, n), cross(pose.armB, n)};
}

inline Jacobian turnJacobian()
{
    return {{}, {}, -1, 1};
}

/// Where B's anchor is along an axis that is fixed in A, and how it moves along it.
inline JointCoordinate slideAlong(Vec2 axis, const JointPose& pose)
{
    return {static_cast<double>(dot(axis, pose.between)), slideJacobian(axis, pose)};
}

/// How B has turned against A.
inline JointCoordinate turnOf(const JointPose& pose)
{
    return {pose.angle, turnJacobian()};
}

/// Two rigid rows: the points stay together.
void addPoint(const JointPose& pose, JointRows& out);
/// One rigid row: B's anchor stays on an axis that is fixed in A.
void addSlide(Vec2 axis, const JointPose& pose, JointRows& out);

/// What may stand at a joint's free coordinate, at `position` along `j`.
void addSpring(const JointSpring& spring, int slot, const Jacobian& j, double position, real mass,
               bool angular, JointRows& out);
void addMotor(const std::optional<JointMotor>& motor, const Jacobian& j, bool angular, JointRows& out);
void addLimits(const std::optional<JointLimits>& limits, const Jacobian& j, double position, bool angular,
               JointRows& out);

}  // namespace tamias2d::inline TAMIAS_PRECISION
