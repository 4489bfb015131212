// SPDX-License-Identifier: MIT
// Between a hinge of the JointTable and its lane.
#pragma once

#include "model/joints.hpp"
#include "solver/contact_block.hpp"
#include "solver/hinge_block.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

template <int W>
void setDouble(DoubleLane<W>& wide, int lane, double value)
{
    if constexpr (W == 1)
        wide.v = value;
    else
        wide.v[lane / DoubleLane<W>::kWidth][lane % DoubleLane<W>::kWidth] = value;
}
template <int W>
double doubleOf(const DoubleLane<W>& wide, int lane)
{
    if constexpr (W == 1)
        return wide.v;
    else
        return wide.v[lane / DoubleLane<W>::kWidth][lane % DoubleLane<W>::kWidth];
}

/// Impulses at the point, by the slots of a joint, and those about the angle.
template <int W>
void readImpulses(const real* from, int lane, BasicVec2<Lane<W>>& to)
{
    setLane(to, lane, {from[JointSlot::kBlock], from[JointSlot::kBlock + 1]});
}
template <class Wide>
void readImpulses(const real* from, int lane, AngleImpulses<Wide>& to)
{
    to.spring.v[lane] = from[JointSlot::kSpring];
    to.motor.v[lane] = from[JointSlot::kMotor];
    to.limits[0].v[lane] = from[JointSlot::kLower];
    to.limits[1].v[lane] = from[JointSlot::kUpper];
}
template <int W>
void writeImpulses(const BasicVec2<Lane<W>>& from, int lane, real* to)
{
    to[JointSlot::kBlock] = from.x.v[lane];
    to[JointSlot::kBlock + 1] = from.y.v[lane];
}
template <class Wide>
void writeImpulses(const AngleImpulses<Wide>& from, int lane, real* to)
{
    to[JointSlot::kSpring] = from.spring.v[lane];
    to[JointSlot::kMotor] = from.motor.v[lane];
    to[JointSlot::kLower] = from.limits[0].v[lane];
    to[JointSlot::kUpper] = from.limits[1].v[lane];
}

/// The way in of what stands at its angle. `invInertia` is the sum of those of its bodies.
template <int W>
void placeAngle(HingeAngle<W>& angle, int lane, const JointRow& joint, real invInertia)
{
    const auto& hinge = std::get<RevoluteJoint>(joint.def.kind);
    const std::uint32_t bit = 1u << lane;
    angle.work[lane] = joint.stepWork;
    if (hinge.spring) {
        const real inertia = invInertia > 0 ? 1 / invInertia : real(0);
        const real turn = static_cast<real>(kTwoPi) * hinge.spring->frequency;
        angle.springs |= bit;
        angle.stiffness.v[lane] = inertia * turn * turn;
        angle.damping.v[lane] = 2 * hinge.spring->dampingRatio * inertia * turn;
        setDouble(angle.zero, lane, hinge.referenceAngle + static_cast<double>(hinge.spring->rest));
    }
    if (hinge.motor) {
        angle.motors |= bit;
        angle.speed.v[lane] = hinge.motor->speed;
        angle.strength.v[lane] = hinge.motor->maxForce;
    }
    const auto limit = [&](int side, real at, bool has) {
        if (!has) return;
        angle.limited[side] |= bit;
        setDouble(angle.rest[side], lane, hinge.referenceAngle + static_cast<double>(at));
        if (joint.held[side]) angle.held[side] |= bit;
    };
    if (hinge.limits) {
        limit(0, hinge.limits->lower, hinge.limits->lower > -kUnlimited);
        limit(1, hinge.limits->upper, hinge.limits->upper < kUnlimited);
    }
    readImpulses(joint.impulses, lane, angle.carried);
    readImpulses(joint.stepSums, lane, angle.sums);
}

/// The way out of a hinge: what it did in the step, and what it carries on.
template <int W>
void storeHinge(const HingeSource<W>& source, const HingeAngle<W>* angle, int lane, JointRow& joint)
{
    joint.forgetLoads();
    writeImpulses(source.carried, lane, joint.impulses);
    writeImpulses(source.sums, lane, joint.stepSums);
    joint.stepImpulse = laneOf(source.sums, lane);
    joint.angle = doubleOf(source.angle, lane);
    joint.strainedTicks = source.strained[lane];
    joint.held[0] = joint.held[1] = false;
    if (angle == nullptr) return;
    writeImpulses(angle->carried, lane, joint.impulses);
    writeImpulses(angle->sums, lane, joint.stepSums);
    const real* const sums = joint.stepSums;
    joint.stepTurn = sums[JointSlot::kSpring] + sums[JointSlot::kMotor] + sums[JointSlot::kLower] -
                     sums[JointSlot::kUpper];
    joint.stepWork = angle->work[lane];
    for (const int side : {0, 1}) joint.held[side] = (angle->held[side] >> lane & 1u) != 0;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
