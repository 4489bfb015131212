// SPDX-License-Identifier: MIT
#include "joints/reading.hpp"

#include "joints/own.hpp"

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
    bool acts = joint.ties();
    joint.eachBody([&](std::uint32_t body) { acts = acts && bodies.rows[body].enabled; });
    return acts;
}

JointPose poseNow(const JointRow& joint, const BodyTable& bodies, const Motion& a, const Motion& b)
{
    const double turned = countTurns(a.angle, b.angle, joint.angle);
    return poseOf(joint, bodies, a, b, placeOf(a), placeOf(b), turned);
}

// The rows where the bodies are now, and the position that they say.
struct RowsNow {
    JointRows rows;
    MoreBodies more;
    double position = 0;   // [m] or [rad]
    real speed = 0;        // [m/s] or [rad/s]
};

void measureNow(const JointRow& joint, const BodyTable& bodies, RowsNow& now)
{
    if (std::holds_alternative<OwnJoint>(joint.def.kind)) {
        measureOwn(joint, ownPoseOf(joint, bodies), now.rows, &now.more);
        const OwnCoordinate at = ownCoordinateOf(joint, bodies);
        now.position = at.position;
        now.speed = at.speed;
        return;
    }
    const Motion a = motionOf(bodies, joint.bodyA), b = motionOf(bodies, joint.bodyB);
    const JointPose pose = poseNow(joint, bodies, a, b);
    const JointCoordinate at =
        std::visit([&](const auto& kind) { return coordinateOf(kind, pose); }, joint.def.kind);
    measureJoint(joint.def.kind, pose, now.rows);
    now.position = at.position;
    now.speed = speedAlong(at.j, {a.velocity, a.spin}, {b.velocity, b.spin});
}

}  // namespace

JointReading readJoint(const JointRow& joint, const BodyTable& bodies, double dt)
{
    JointReading reading;
    if (!actsNow(joint, bodies)) return reading;
    RowsNow now;
    measureNow(joint, bodies, now);
    const JointRows& rows = now.rows;
    reading.position = now.position;
    reading.speed = now.speed;
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

std::vector<JointRowReading> readRows(const JointRow& joint, const BodyTable& bodies, double dt)
{
    std::vector<JointRowReading> readings;
    if (!actsNow(joint, bodies)) return readings;
    RowsNow now;
    measureNow(joint, bodies, now);
    const auto velocityOf = [&](std::uint32_t body) {
        return BodyMotion<real>{bodies.rows[body].velocity, bodies.rows[body].spin};
    };
    for (int i = 0; i < now.rows.count; ++i) {
        const ConstraintRow& row = now.rows.rows[i];
        JointRowReading reading{row.kind, row.angular, row.error,
                                speedAlong(row.j, velocityOf(joint.bodyA), velocityOf(joint.bodyB))};
        for (std::size_t k = 0; k < joint.more.size(); ++k) {
            const ConstraintRows::Part& part = now.more.parts[i][k];
            const BodyMotion<real> v = velocityOf(joint.more[k]);
            reading.speed += dot(part.linear, v.velocity) + part.turn * v.spin;
        }
        if (dt > 0) reading.force = static_cast<real>(1 / dt) * joint.stepSums[row.slot];
        readings.push_back(reading);
    }
    return readings;
}

std::pair<Position, Position> ownAnchorsOf(const JointRow& joint, const BodyTable& bodies)
{
    RowsNow now;
    measureOwn(joint, ownPoseOf(joint, bodies), now.rows, &now.more);
    if (joint.bodyA == joint.bodyB) now.rows.armA = now.rows.armB;
    return {bodies.rows[joint.bodyA].center + toDVec2(now.rows.armA),
            bodies.rows[joint.bodyB].center + toDVec2(now.rows.armB)};
}

double springEnergy(const JointTable& joints, const BodyTable& bodies)
{
    double sum = 0;
    for (std::uint32_t slot = 0; slot < joints.rows.size(); ++slot) {
        const JointRow& joint = joints.rows[slot];
        if (!joints.ids.isAlive(slot) || !actsNow(joint, bodies)) continue;
        RowsNow now;
        measureNow(joint, bodies, now);
        sum += energyOfSprings(now.rows);
    }
    return sum;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
