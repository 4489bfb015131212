// SPDX-License-Identifier: MIT
// Visits to joints, one by one and by groups, before the drift and after it.

#include "solver/joint_passes.hpp"

#include <tamias2d/math/scalar.hpp>

#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {

void passOverJoints(const JointWorld& world, JointSystem& system, real restless, const std::uint8_t* visited,
                    Table<LaneRow>& velocities, std::vector<std::uint8_t>& unrest)
{
    const Table<Motion>& motions = world.motions.rows;
    const auto islandOf = [&](const JointRows& joint) {
        return world.islands.islandOf[joint.movingRow(motions)];
    };
    const auto isVisited = [&](const JointRows& joint) {
        return visited == nullptr || visited[islandOf(joint)] != 0;
    };
    if (!world.hinges.empty()) {
        if (visited == nullptr)
            world.hinges.firstPass(world.motions.rows, world.rows, system.wholeGroups, unrest.data(),
                                   restless, world.context);
        else
            world.hinges.pass(world.motions.rows, world.rows, visited, unrest.data(), restless,
                              world.context);
    }
    for (JointRows& joint : system.joints) {
        if (!isVisited(joint) || system.piledGroups[joint.group]) continue;
        if (visited != nullptr && system.lostGroups[joint.group] == 0) aimJoint(world, velocities, joint);
        if (system.stiffGroups[joint.group]) continue;
        if (visitJoint(joint, motions, velocities) > restless) unrest[islandOf(joint)] = 1;
    }
    for (std::size_t d = 0; d < system.directCount; ++d) {
        DirectGroup& group = system.direct[d];
        const JointRows& first = system.joints[group.joints.front()];
        if (!isVisited(first) || system.piledGroups[first.group]) continue;
        if (visitGroup(group, system, motions, velocities) > restless) unrest[islandOf(first)] = 1;
    }
}

void settleJoints(JointSystem& system, HingeLanes& hinges, const Table<Motion>& rows, TickRows& lanes,
                  const StepContext& context)
{
    const real restless = context.tuning.restless * context.lengthUnit;
    std::vector<std::uint32_t>&changed = system.changed, &before = system.changedBefore;
    std::vector<std::uint8_t>& visited = system.visited;
    const std::size_t groups = system.wholeGroups.size();
    visited.assign(groups, 1);
    before.assign(groups, std::numeric_limits<std::uint32_t>::max());
    for (int pass = 0; pass <= context.tuning.extraPasses; ++pass) {
        changed.assign(groups, 0);
        if (!hinges.empty())
            hinges.settlingPass(lanes, pass == 0 ? nullptr : visited.data(), changed.data(), restless);
        for (JointRows& joint : system.joints) {
            if (system.stiffGroups[joint.group] || visited[joint.group] == 0) continue;
            if (visitJoint(joint, rows, lanes.velocities) > restless) ++changed[joint.group];
        }
        // Where no fewer change than in the pass before, more of them settle nothing.
        bool any = false;
        for (std::size_t group = 0; group < groups; ++group) {
            visited[group] = changed[group] != 0 && changed[group] < before[group];
            any = any || visited[group] != 0;
        }
        before.swap(changed);
        if (!any) break;
    }
    for (std::size_t d = 0; d < system.directCount; ++d)
        visitGroup(system.direct[d], system, rows, lanes.velocities);
}

namespace {

// One visit to a joint of more than two bodies.
real visitMany(JointRows& joint, const Table<Motion>& motions, Table<LaneRow>& velocities)
{
    BodySet set = bodySetOf(joint, motions, [&](std::uint32_t row) { return velocityOf(velocities[row]); });
    const real change = solveRows(joint, set);
    int k = 0;
    joint.eachRow([&](std::uint32_t row) {
        if (set.motions[k]->moves()) setVelocity(velocities[row], set.velocities[k]);
        ++k;
    });
    return change;
}

}  // namespace

real visitJoint(JointRows& joint, const Table<Motion>& motions, Table<LaneRow>& velocities)
{
    if (joint.more) return visitMany(joint, motions, velocities);
    BodyPair pair{motions[joint.rowA], motions[joint.rowB], velocityOf(velocities[joint.rowA]),
                  velocityOf(velocities[joint.rowB])};
    const real change = solveRows(joint, pair);
    if (pair.a.moves()) setVelocity(velocities[joint.rowA], pair.va);
    if (pair.b.moves()) setVelocity(velocities[joint.rowB], pair.vb);
    return change;
}

real visitGroup(DirectGroup& group, JointSystem& system, const Table<Motion>& motions,
                Table<LaneRow>& velocities)
{
    std::vector<BodyMotion<real>>& own = system.velocities;
    own.clear();
    for (const std::uint32_t row : group.rows) own.push_back(velocityOf(velocities[row]));
    real change = solveDirect(group, system.joints, motions, own);
    if (change >= 0) {
        for (std::size_t n = 0; n < group.rows.size(); ++n) setVelocity(velocities[group.rows[n]], own[n]);
        return change;
    }
    for (const std::uint32_t j : group.joints)
        change = maximum(change, visitJoint(system.joints[j], motions, velocities));
    ++system.fallbacks;
    return change;
}

real aimJoint(const JointWorld& world, const Table<LaneRow>& velocities, JointRows& joint)
{
    const auto velocityAt = [&](std::uint32_t row) { return velocityOf(velocities[row]); };
    return aimJoint(world.joints, world.bodies, world.motions, velocityAt, world.context, joint);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
