// SPDX-License-Identifier: MIT
// Joints of one's own: asks their constraints where bodies are, looks at what these answer, and makes rows of
// it like those of the kinds.
#pragma once

#include "joints/pose.hpp"

#include <string>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The bodies of such a joint, in the order in which they were given.
struct OwnPose {
    int count = 0;
    ConstraintBody bodies[ConstraintRows::kMostBodies];

    std::span<const ConstraintBody> all() const { return {bodies, static_cast<std::size_t>(count)}; }
};

/// As they are now.
OwnPose ownPoseOf(const JointRow& joint, const BodyTable& bodies);

/// Calls the constraint and looks at its answer, which is sound if it has no problem then. What the
/// constraint threw goes to `thrown`.
void askConstraint(const OwnJoint& kind, const OwnPose& pose, ConstraintRows& answer,
                   std::string* thrown = nullptr);

/// Which rows there are: the same number for the same ones in the same order. Never 0.
std::uint32_t layoutOf(const ConstraintRows& answer);

/// Into how many parts the rows of a layout fall that are solved one after the other; 0 of none.
int blocksOf(std::uint32_t layout);

/// The joint's rows at a pose: those beyond two bodies go to `more`. False, and no rows, if the constraint
/// threw, or answered nonsense, or other rows than before.
bool measureOwn(const JointRow& joint, const OwnPose& pose, JointRows& out, MoreBodies* more);

/// What a reading calls the joint's position, with how fast it grows at the velocities that bodies have now.
struct OwnCoordinate {
    double position = 0;  // [m] or [rad]
    real speed = 0;  // [m/s] or [rad/s]
};
OwnCoordinate ownCoordinateOf(const JointRow& joint, const BodyTable& bodies);

/// Counts the turns of a joint's bodies: from now on, or onwards.
void beginOwnCount(JointRow& joint, const BodyTable& bodies);
void followOwnCount(JointRow& joint, const MotionTable& motions);

/// The rows at work, where the bodies are now.
bool measureOwnNow(const JointRow& joint, const BodyTable& bodies, const MotionTable& motions,
                   JointRows& rows);

/// Where they are expected to be after a tick at these velocities; false as above.
bool measureOwnAhead(const JointRow& joint, const BodyTable& bodies, const BodySet& set, real h,
                     JointRows& out);

}  // namespace tamias2d::inline TAMIAS_PRECISION
