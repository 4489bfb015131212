// SPDX-License-Identifier: MIT
#pragma once

#include "math/double_lane.hpp"

#include <cstddef>
#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

/// One side of the limits of W hinges in the visits of the moment. Lanes without it have bounds of 0.
template <class Wide>
struct HingeLimit {
    Wide bias, firm, loose, low, high, impulse;
};

/// What the four rows about the angles of W hinges have to do with impulses: of the spring, the motor and the
/// two limits.
template <class Wide>
struct AngleImpulses {
    Wide spring, motor, limits[2];
};

/// W hinges of one color side by side, as the passes need them; the names are those of ConstraintRow and
/// RowVisit. An empty lane has zeros in all places, which move nothing. Sets of lanes are bits, lane 0
/// lowest.
template <int W>
struct HingeBlock {
    using Wide = Lane<W>;
    static constexpr std::uint32_t kNone = 0xffffffffu;

    std::uint32_t rowA[W] = {}, rowB[W] = {};
    std::uint32_t active = 0;  // lanes with a hinge
    std::uint32_t movesA = 0, movesB = 0;  // lanes whose body can be pushed
    std::uint32_t angle = kNone;  // its HingeAngle, if any of them has rows about the angle
    bool oneGroup = true, oneIsland = true;  // are all lanes of the same?

    // The point: C is the way from A's anchor to B's.
    BasicVec2<Wide> armA, armB, invMassA, invMassB;
    Wide invInertiaA, invInertiaB;
    Wide massX, massY, inverseXX, inverseXY, inverseYY;
    BasicVec2<Wide> bias, impulse;
    BasicVec2<Wide> goal;  // of its bias: what does not depend on velocities
    std::uint32_t group[W] = {}, island[W] = {};

    bool turns() const { return angle != kNone; }
};

/// The rows about the angle of the hinges of a block.
template <int W>
struct HingeAngle {
    using Wide = Lane<W>;
    using Double = DoubleLane<W>;

    Wide massTurn, reach;
    Wide push, give, spring;  // the last is its impulse
    Wide speed, most, motor;  // likewise
    HingeLimit<Wide> limits[2];  // lower, upper

    // What the passes do not need.
    std::uint32_t springs = 0, motors = 0, limited[2] = {};  // lanes that have these rows
    std::uint32_t held[2] = {};  // as that of JointRow
    double work[W] = {};  // JointRow::stepWork
    Double zero, rest[2];  // what a spring and the limits count from
    Wide springError, limitError[2];
    Wide stiffness, damping, strength;  // of the spring, of the motor
    AngleImpulses<Wide> carried, first, sums;
};

/// What the passes do not need of the points.
template <int W>
struct HingeSource {
    using Wide = Lane<W>;

    std::uint32_t joint[W] = {};  // slot
    std::uint32_t damped = 0;  // lanes with a damped body
    std::uint32_t whole = 0, lost = 0;  // as those of JointRows
    std::uint32_t stiffened = 0;  // lanes that are to be solved at once from the next step on
    bool anyStrained = false;  // is any of the next not 0?
    int strained[W] = {};  // JointRow::strainedTicks

    BasicVec2<Wide> localA, localB;  // anchors from the centers of mass, in the bodies' frames   [m]
    BasicVec2<Wide> start;  // from A's center to B's at the start of the step   [m]
    BasicVec2<Wide> error;
    DoubleLane<W> angle;  // JointRow::angle
    BasicVec2<Wide> carried, first, sums;  // impulses
};

/// Blocks that follow each other; their angles stand elsewhere.
template <int W>
struct HingeRun {
    HingeBlock<W>* blocks;
    HingeSource<W>* sources;
    HingeAngle<W>* angles;
    std::size_t count;

    /// Null if nothing is asked about it.
    HingeAngle<W>* angleOf(const HingeBlock<W>& block) const
    {
        return block.turns() ? angles + block.angle : nullptr;
    }
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
