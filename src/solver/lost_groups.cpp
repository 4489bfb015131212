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

// Rows that others already settle may carry any loads that cancel each other. Let go one by one they would
// throw the bodies: the group begins without any. It would be thrown again: unless it is small, it is not
// solved at once for some steps.
void forgetLoads(JointTable& joints, const Table<Motion>& motions, const JointSystem& system,
                 const DirectGroup& group, Table<LaneRow>& velocities)
{
    for (const std::uint32_t j : group.joints) {
        const JointRows& joint = system.joints[j];
        JointRow& carried = joints.rows[joint.joint];
        const real part = joint.whole ? real(-1) : real(-0.5);
        BodyPair pair{motions[joint.rowA], motions[joint.rowB], velocityOf(velocities[joint.rowA]),
                      velocityOf(velocities[joint.rowB])};
        for (int i = 0; i < joint.count; ++i)
            applyTo(joint, i, part * carried.impulses[joint.rows[i].slot], pair);
        if (pair.a.moves()) setVelocity(velocities[joint.rowA], pair.va);
        if (pair.b.moves()) setVelocity(velocities[joint.rowB], pair.vb);
        carried.forgetLoads();
        if (group.rows.size() > kFew) carried.stiffSteps = -kHold;
    }
}

// Projects a group, or leaves it as if it had no joints.
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

// Of the fastest point of a body.
real speedOf(const Motion& m, const LaneRow& velocity)
{
    return length(Vec2{velocity.x, velocity.y}) + absolute(velocity.z) * m.extent;
}

// Soft rows cannot be trusted with uneven masses.
bool mayBeSoftened(const JointSystem& system, const DirectGroup& group)
{
    if (group.rows.empty()) return false;
    const std::uint32_t of = system.joints[group.joints.front()].group;
    return !system.unevenGroups[of] && !system.piledGroups[of];
}

}  // namespace

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

bool mayThrow(const JointSystem& system)
{
    return std::any_of(system.direct.begin(),
                       system.direct.begin() + static_cast<std::ptrdiff_t>(system.directCount),
                       [&](const DirectGroup& group) { return mayBeSoftened(system, group); });
}

bool softenThrown(const JointWorld& world, JointTable& joints, JointSystem& system, Table<LaneRow>& before,
                  Table<LaneRow>& after)
{
    const Table<Motion>& motions = world.motions.rows;
    const Islands& islands = world.islands;
    const StepContext& context = world.context;
    constexpr real kThrown = 4;  // times the fastest so far: more than a whip gains in a tick
    std::vector<real>& fastest = system.fastest;
    fastest.assign(islands.count(), 0);
    real driven = 0;  // of bodies that nothing can push
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const std::uint32_t island = islands.islandOf[i];
        real& most = island == Islands::kNone ? driven : fastest[island];
        most = maximum(most, speedOf(motions[i], before[i]));
    }
    bool thrown = false;
    for (std::size_t d = system.directCount; d-- > 0;) {
        DirectGroup& group = system.direct[d];
        const std::uint32_t of = system.groupOfDirect(d);
        if (!mayBeSoftened(system, group) || system.thrownGroups[of] != 0) continue;
        const std::uint32_t island = islands.islandOf[group.rows.front()];
        const real known = (island == Islands::kNone ? real(0) : fastest[island]) + driven;
        const real bound = kThrown * (known + driveOf(system, group)) + context.lengthUnit;
        const bool within = std::all_of(group.rows.begin(), group.rows.end(), [&](std::uint32_t row) {
            return speedOf(motions[row], after[row]) <= bound;
        });
        if (within) continue;
        if (!system.wholeGroups[of] && project(world, system, group, before, after)) {
            system.thrownGroups[of] = 1;  // for when all passes are over
            for (std::size_t k = 0; k < group.joints.size(); ++k)
                system.joints[group.joints[k]] = system.projection.begun[k];
            continue;
        }
        forgetLoads(joints, motions, system, group, before);
        soften(system, d);
        thrown = true;
    }
    return thrown;
}

real driveOf(const JointSystem& system, const DirectGroup& group)
{
    real sum = 0;
    for (const std::uint32_t j : group.joints) {
        const JointRows& joint = system.joints[j];
        for (int i = 0; i < joint.count; ++i) {
            const ConstraintRow& row = joint.rows[i];
            const RowVisit& visit = joint.visits[i];
            const real pushed =
                row.kind == RowKind::Spring ? row.mass * minimum(absolute(visit.push), visit.high) : real(0);
            sum += (absolute(row.speed) + pushed) * (row.angular ? joint.reach : real(1));
        }
    }
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
