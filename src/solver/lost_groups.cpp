// SPDX-License-Identifier: MIT
// Groups of joints that the passes did not bring to where they go, or threw beyond it.
// docs/theory/joints.md, section 9.

#include "joints/projection.hpp"
#include "joints/softness.hpp"
#include "solver/joint_passes.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr real kTrust = 1;   // change of what a joint aims at, after the last pass   [lengthUnit/s]

// The velocities of a group without what its joints did in this half of the tick, by node. Where no contact
// answered these they are known from before the passes.
void takeBackJoints(const JointWorld& world, const JointSystem& system, const DirectGroup& group,
                    const Table<LaneRow>& before, const Table<LaneRow>& now,
                    std::vector<BodyMotion<real>>& velocities)
{
    const bool whole = system.joints[group.joints.front()].whole;
    const bool guarded =
        !group.begins && std::any_of(group.joints.begin(), group.joints.end(),
                                     [&](std::uint32_t j) { return system.joints[j].turnMass > 0; });
    velocities.clear();
    for (const std::uint32_t row : group.rows)
        velocities.push_back(velocityOf(whole ? now[row] : before[row]));
    if (whole && guarded) {
        for (std::size_t n = 0; n < velocities.size(); ++n) {
            velocities[n].velocity -=
                {static_cast<real>(group.given[3 * n]), static_cast<real>(group.given[3 * n + 1])};
            velocities[n].spin -= static_cast<real>(group.given[3 * n + 2]);
        }
        return;
    }
    for (std::size_t k = 0; k < group.joints.size(); ++k) {
        const JointRows& joint = system.joints[group.joints[k]];
        const JointRow& carried = world.joints.rows[joint.joint];
        const auto [a, b] = group.nodes[k];
        BodyPair pair{world.motions.rows[joint.rowA], world.motions.rows[joint.rowB], {}, {}};
        if (a >= 0) pair.va = velocities[static_cast<std::size_t>(a)];
        if (b >= 0) pair.vb = velocities[static_cast<std::size_t>(b)];
        for (int i = 0; i < joint.count; ++i)
            applyTo(joint, i, whole ? -joint.visits[i].impulse : -carried.impulses[joint.rows[i].slot] / 2,
                    pair);
        if (a >= 0) velocities[static_cast<std::size_t>(a)] = pair.va;
        if (b >= 0) velocities[static_cast<std::size_t>(b)] = pair.vb;
    }
}

// Which groups the passes did not settle: there, what joints aim at still changes, or loads came up that the
// tick was not begun for.
void findLost(const JointWorld& world, const Table<LaneRow>& velocities, JointSystem& system)
{
    const real trusted = kTrust * world.context.lengthUnit;
    std::vector<std::uint8_t>&lost = system.lostGroups, &torn = system.tornGroups,
    &outgrown = system.outgrownGroups;
    lost.assign(system.wholeGroups.size(), 0);
    for (JointRows& joint : system.joints) {
        const real change = aimJoint(world, velocities, joint);
        if (!(change <= trusted)) lost[joint.group] = 1;
    }
    if (!world.hinges.empty())
        world.hinges.findLost(world.motions.rows, world.rows, lost, trusted, world.context);
    for (std::size_t group = 0; group < lost.size(); ++group) lost[group] |= system.thrownGroups[group];
    torn = lost;
    findTorn(system, world.context, torn);
    for (std::uint32_t group = 0; group < torn.size(); ++group)
        if (torn[group] != 0 && mayBeStiffened(system, group) && stiffen(system, world.motions.rows, group))
            lost[group] = 1;
    outgrown.assign(lost.size(), 0);
    findOutgrown(system, world.motions.rows, world.context, outgrown);
    for (std::size_t d = 0; d < system.directCount; ++d) {
        const std::uint32_t group = system.groupOfDirect(d);
        if (outgrown[group] != 0 && mayBeProjected(system, system.direct[d])) lost[group] = 1;
    }
    for (JointRows& joint : system.joints) joint.lost = lost[joint.group] != 0;
}

}  // namespace

bool project(const JointWorld& world, JointSystem& system, DirectGroup& group, const Table<LaneRow>& before,
             Table<LaneRow>& velocities)
{
    if (!mayBeProjected(system, group)) return false;
    std::vector<BodyMotion<real>>& own = system.velocities;
    takeBackJoints(world, system, group, before, velocities, own);
    const bool found =
        projectGroup(world.joints, world.bodies, world.motions, world.context, system, group, own);
    for (std::size_t n = 0; n < group.rows.size(); ++n) setVelocity(velocities[group.rows[n]], own[n]);
    if (found) return true;
    group.begins = true;
    for (const std::uint32_t j : group.joints) {
        JointRows& joint = system.joints[j];
        joint.turnMass = 0;
        for (RowVisit& visit : joint.visits) visit.impulse = 0;
    }
    return false;
}

void settleLost(const JointWorld& world, JointSystem& system, const Table<LaneRow>& before,
                Table<LaneRow>& velocities)
{
    findLost(world, velocities, system);
    std::vector<std::uint8_t>& lost = system.lostGroups;
    for (std::size_t d = 0; d < system.directCount; ++d) {
        std::uint8_t& is = lost[system.groupOfDirect(d)];
        if (is != 0 && project(world, system, system.direct[d], before, velocities)) is = 0;
    }
    if (!world.hinges.empty() && std::find(lost.begin(), lost.end(), std::uint8_t{1}) != lost.end())
        world.hinges.flatten(lost, world.rows, world.context);
    for (JointRows& joint : system.joints) {
        if (lost[joint.group] == 0) continue;
        flattenRows(joint, world.context);
        if (!system.stiffGroups[joint.group]) visitJoint(joint, world.motions.rows, velocities);
    }
    for (std::size_t d = system.directCount; d-- > 0;) {
        const std::uint32_t group = system.groupOfDirect(d);
        if (lost[group] == 0) continue;
        visitGroup(system.direct[d], system, world.motions.rows, velocities);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
