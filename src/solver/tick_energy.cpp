// SPDX-License-Identifier: MIT
#include "solver/tick_energy.hpp"

#include "joints/softness.hpp"
#include "solver/body_mass.hpp"

#include <tamias2d/math/scalar.hpp>

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr double kMadeByLoops = 1e-3;  // of the energy: what rounding and rows that are not settled may make
constexpr double kMadeByTrees = 0.1;  // the same, as the second half of a tick takes it again: whips

constexpr double kBack = 0.1;  // a speed at which errors may come back   [lengthUnit/s]

// Twice, of a body.
double energyOf(const Motion& m, const BodyMotion<real>& velocity)
{
    double sum = 0;
    const auto add = [&](real speed, real inverse) {
        const double s = static_cast<double>(speed);
        if (inverse > 0) sum += s * s / static_cast<double>(inverse);
    };
    add(velocity.velocity.x, m.invMass.x);
    add(velocity.velocity.y, m.invMass.y);
    add(velocity.spin, m.invInertia);
    return sum;
}

// As the first kick left it, without the share of what is carried that this has given.
BodyMotion<real> unloaded(const TickRows& lanes, std::uint32_t row)
{
    const TickChange& kicked = lanes.changes[row];  // less the velocity with which the passes begin
    const LaneRow& steady = lanes.steady[row];
    const real part = steady.w > 0 ? real(1) : real(0.5);
    return {{-kicked.velocity.x - part * steady.x, -kicked.velocity.y - part * steady.y},
            -kicked.spin - part * steady.z};
}

// Has a hinge in lanes a motor or a spring?
bool isDriven(const JointTable& joints, const JointTie& tie)
{
    const auto* const hinge = std::get_if<RevoluteJoint>(&joints.rows[tie.joint].def.kind);
    return hinge != nullptr && (hinge->motor || hinge->spring);
}

}  // namespace

void TickEnergy::add(const TickRows& lanes, const Motion& motion, std::uint32_t row,
                     const BodyMotion<real>& after)
{
    begun += energyOf(motion, unloaded(lanes, row));
    ended += energyOf(motion, after);
    turn = maximum(turn, absolute(after.spin));
    mass += massOf(motion);
}

bool TickEnergy::isMade(const StepContext& context, bool inLoops) const
{
    const double made = inLoops ? kMadeByLoops : kMadeByTrees;
    const double turned = static_cast<double>(minimum(context.h * turn, real(1)));
    const double back = kBack * static_cast<double>(context.lengthUnit);
    const double known =
        std::sqrt(begun * (1 + made + turned * turned / 2)) + std::sqrt(mass) * static_cast<double>(drive);
    return !(ended <= known * known + mass * back * back);
}

void tallyEnergies(const JointTable& joints, const Table<Motion>& motions, const Islands& islands,
                   const JointSystem& system, const TickRows& lanes, real drive,
                   std::vector<TickEnergy>& byIsland)
{
    byIsland.assign(islands.count(), {.drive = drive});
    for (std::uint32_t row = 0; row < motions.size(); ++row)
        if (const std::uint32_t island = islands.islandOf[row]; island != Islands::kNone)
            byIsland[island].add(lanes, motions[row], row, velocityOf(lanes.velocities[row]));
    const auto islandOf = [&](const JointTie& tie) { return islands.islandOf[tie.movingRow(motions)]; };
    for (const JointRows& joint : system.joints)
        if (const std::uint32_t island = islandOf(joint); island != Islands::kNone)
            byIsland[island].drive += driveOf(joint);
    for (const JointTie& tie : system.hinges)
        if (const std::uint32_t island = islandOf(tie); island != Islands::kNone && isDriven(joints, tie))
            byIsland[island].drive = kUnlimited;
}

real fastestSurface(const ContactTable& contacts)
{
    real most = 0;
    for (const Contact& c : contacts.rows) most = maximum(most, absolute(c.surfaceSpeed));
    return most;
}

real driveOf(const JointRows& joint)
{
    real sum = 0;
    for (int i = 0; i < joint.count; ++i) {
        const ConstraintRow& row = joint.rows[i];
        const RowVisit& visit = joint.visits[i];
        const real pushed =
            row.kind == RowKind::Spring ? row.mass * minimum(absolute(visit.push), visit.high) : real(0);
        sum += (absolute(row.speed) + pushed) * (row.angular ? joint.reach : real(1));
    }
    return sum;
}

real driveOf(const JointSystem& system, const DirectGroup& group)
{
    real sum = 0;
    for (const std::uint32_t j : group.joints) sum += driveOf(system.joints[j]);
    return sum;
}

real drivenSpeed(const Table<Motion>& motions)
{
    real most = 0;
    for (const Motion& m : motions)
        if (!m.moves()) most = maximum(most, length(m.velocity) + absolute(m.spin) * m.extent);
    return most;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
