// SPDX-License-Identifier: MIT
#include "joints/reading.hpp"

#include "joints/pose.hpp"

#include <tamias2d/math/scalar.hpp>

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr real kAtLimit = real(1e-5);   // what rests there unloaded is so near   [m] or [rad]

// How far apart is what should be together? A limit counts where it is overrun.
void readErrors(const JointRows& rows, JointReading& reading)
{
    double linear = 0, angular = 0;
    for (int i = 0; i < rows.count; ++i) {
        const ConstraintRow& row = rows.rows[i];
        const bool wrong = row.kind == RowKind::Rigid || (row.kind == RowKind::Limit && row.error < 0);
        if (!wrong) continue;
        const double error = static_cast<double>(row.error);
        (row.angular ? angular : linear) += error * error;
    }
    reading.error = static_cast<real>(std::sqrt(linear));
    reading.angularError = static_cast<real>(std::sqrt(angular));
}

double energyOfSprings(const JointRows& rows)
{
    double energy = 0;
    for (int i = 0; i < rows.count; ++i) {
        const ConstraintRow& row = rows.rows[i];
        if (row.kind != RowKind::Spring) continue;
        const double error = static_cast<double>(row.error);
        energy += static_cast<double>(row.stiffness) * error * error / 2;
    }
    return energy;
}

bool actsNow(const JointRow& joint, const BodyTable& bodies)
{
    return joint.ties() && bodies.rows[joint.bodyA].enabled && bodies.rows[joint.bodyB].enabled;
}

JointPose poseNow(const JointRow& joint, const BodyTable& bodies, const Motion& a, const Motion& b)
{
    const double turned = countTurns(a.angle, b.angle, joint.angle);
    return poseOf(joint, bodies, a, b, placeOf(a), placeOf(b), turned);
}

}  // namespace

JointReading readJoint(const JointRow& joint, const BodyTable& bodies, double dt)
{
    JointReading reading;
    if (!actsNow(joint, bodies)) return reading;
    const Motion a = motionOf(bodies, joint.bodyA), b = motionOf(bodies, joint.bodyB);
    const JointPose pose = poseNow(joint, bodies, a, b);
    const JointCoordinate at =
        std::visit([&](const auto& kind) { return coordinateOf(kind, pose); }, joint.def.kind);
    reading.position = at.position;
    reading.speed = speedAlong(at.j, {a.velocity, a.spin}, {b.velocity, b.spin});
    JointRows rows;
    measureJoint(joint.def.kind, pose, rows);
    readErrors(rows, reading);
    reading.springEnergy = energyOfSprings(rows);
    for (int i = 0; i < rows.count; ++i) {
        const ConstraintRow& row = rows.rows[i];
        if (row.kind != RowKind::Limit) continue;
        const int side = row.slot - JointSlot::kLower;
        if (joint.held[side] || row.error <= kAtLimit)
            reading.limit = side == 0 ? LimitState::AtLower : LimitState::AtUpper;  // a rope's end is upper
    }

    if (!(dt > 0)) return reading;
    const real perTime = static_cast<real>(1 / dt);
    const real* sums = joint.stepSums;
    reading.force = perTime * joint.stepImpulse;
    reading.torque = perTime * joint.stepTurn;
    reading.limitForce =
        perTime * (sums[JointSlot::kLower] - sums[JointSlot::kUpper] - sums[JointSlot::kRope]);
    reading.motorForce = perTime * sums[JointSlot::kMotor];
    reading.motorPower = static_cast<real>(joint.stepWork / dt);
    reading.springForce = perTime * sums[JointSlot::kSpring];
    return reading;
}

double springEnergy(const JointTable& joints, const BodyTable& bodies)
{
    double sum = 0;
    for (std::uint32_t slot = 0; slot < joints.rows.size(); ++slot) {
        const JointRow& joint = joints.rows[slot];
        if (!joints.ids.isAlive(slot) || !actsNow(joint, bodies)) continue;
        const Motion a = motionOf(bodies, joint.bodyA), b = motionOf(bodies, joint.bodyB);
        JointRows rows;
        measureJoint(joint.def.kind, poseNow(joint, bodies, a, b), rows);
        sum += energyOfSprings(rows);
    }
    return sum;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
