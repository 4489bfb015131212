// SPDX-License-Identifier: MIT
#pragma once

#include "math/double_lane.hpp"

#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

/// One side of the limits of W hinges in the visits of the moment. Lanes without it have bounds of 0.
template <class Wide>
struct HingeLimit {
    Wide bias, firm, loose, low, high, impulse;
};

/// What the six rows of W hinges have to do with impulses: of the two of the point, of the spring, the motor
/// and the two limits.
template <class Wide>
struct HingeImpulses {
    BasicVec2<Wide> point;
    Wide spring, motor, limits[2];
};

/// W hinges of one color side by side, as the passes need them; the names are those of ConstraintRow and
/// RowVisit. An empty lane has zeros in all places, which move nothing. Sets of lanes are bits, lane 0
/// lowest.
template <int W>
struct HingeBlock {
    using Wide = Lane<W>;

    std::uint32_t rowA[W] = {}, rowB[W] = {}, group[W] = {}, island[W] = {};
    std::uint32_t active = 0;                // lanes with a hinge
    std::uint32_t movesA = 0, movesB = 0;    // lanes whose body can be pushed
    bool turns = false;                      // have any of them rows about the angle?

    // The point: C is the way from A's anchor to B's.
    BasicVec2<Wide> armA, armB, invMassA, invMassB;
    Wide invInertiaA, invInertiaB, reach;
    Wide massX, massY, inverseXX, inverseXY, inverseYY;
    BasicVec2<Wide> goal;                    // of its bias: what does not depend on velocities
    BasicVec2<Wide> bias, impulse;

    // The angle.
    Wide massTurn;
    Wide push, give, spring;                 // the last is its impulse
    Wide speed, most, motor;                 // likewise
    HingeLimit<Wide> limits[2];              // lower, upper
};

/// What the passes do not need of them.
template <int W>
struct HingeSource {
    using Wide = Lane<W>;
    using Double = DoubleLane<W>;

    std::uint32_t joint[W] = {};             // slot
    std::uint32_t springs = 0, motors = 0, limited[2] = {};   // lanes that have these rows
    std::uint32_t damped = 0;                // lanes with a damped body
    std::uint32_t whole = 0, lost = 0, held[2] = {};   // as those of JointRows and JointRow
    std::uint32_t stiffened = 0;             // lanes that are to be solved at once from the next step on
    int strained[W] = {};                    // JointRow::strainedTicks
    double work[W] = {};                     // JointRow::stepWork

    BasicVec2<Wide> localA, localB;  // anchors from the centers of mass, in the bodies' frames   [m]
    BasicVec2<Wide> start;  // from A's center to B's at the start of the step   [m]
    BasicVec2<Wide> error;
    Double angle, zero, rest[2];  // JointRow::angle; what a spring and the limits count from
    Wide springError, limitError[2];
    Wide stiffness, damping, speed, strength;  // of the spring, of the motor
    HingeImpulses<Wide> carried, first, sums;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
