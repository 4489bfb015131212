// SPDX-License-Identifier: MIT
// Groups that are solved at once and thrown by it: what makes energy, or speed that nothing at hand has.
// docs/theory/joints.md, section 9.

#include "contacts/rows.hpp"
#include "joints/softness.hpp"
#include "solver/solve.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>
#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Of the fastest point of a body.
real speedOf(const Motion& m, const LaneRow& velocity)
{
    return length(Vec2{velocity.x, velocity.y}) + absolute(velocity.z) * m.extent;
}

// Soft rows cannot be trusted with uneven masses.
bool mayBeSoftened(const JointSystem& system, std::uint32_t group)
{
    return system.unevenGroups[group] == 0;
}

// Is it looked at? Uneven ones are where loops tie them.
bool isWatched(const JointSystem& system, const DirectGroup& group)
{
    if (group.rows.empty()) return false;
    const std::uint32_t of = system.joints[group.joints.front()].group;
    return system.piledGroups[of] == 0 && (group.loops || mayBeSoftened(system, of));
}

bool isAnyWatched(const JointSystem& system)
{
    return std::any_of(system.direct.begin(),
                       system.direct.begin() + static_cast<std::ptrdiff_t>(system.directCount),
                       [&](const DirectGroup& group) { return isWatched(system, group); });
}

// Rows that others already settle may carry any loads that cancel each other. Let go one by one they would
// throw the bodies: the group begins without any. It would be thrown again: unless it is a small tree, it is
// not solved at once for some steps.
void forgetLoads(JointTable& joints, const Table<Motion>& motions, const JointSystem& system,
                 const DirectGroup& group, bool softens, Table<LaneRow>& velocities)
{
    for (const std::uint32_t j : group.joints) {
        const JointRows& joint = system.joints[j];
        JointRow& carried = joints.rows[joint.joint];
        const real part = joint.whole ? real(-1) : real(-0.5);
        BodySet set =
            bodySetOf(joint, motions, [&](std::uint32_t row) { return velocityOf(velocities[row]); });
        for (int i = 0; i < joint.count; ++i)
            applyTo(joint, i, part * carried.impulses[joint.rows[i].slot], set);
        int k = 0;
        joint.eachRow([&](std::uint32_t row) {
            if (set.motions[k]->moves()) setVelocity(velocities[row], set.velocities[k]);
            ++k;
        });
        carried.forgetLoads();
        if (softens && (group.rows.size() > kFew || group.loops)) carried.stiffSteps = -kHold;
    }
}

// Looks at the groups after passes that went from `before` to `after`, where surfaces run at `surface` [m/s].
// Returns whether they are to be done again.
bool softenThrown(const JointWorld& world, JointTable& joints, JointSystem& system, real surface,
                  Table<LaneRow>& before, Table<LaneRow>& after)
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
    tallyEnergies(world.joints, motions, islands, system, world.rows, driven + surface, world.energies);
    system.anewGroups.assign(system.wholeGroups.size(), 0);
    bool thrown = false;
    for (std::size_t d = system.directCount; d-- > 0;) {
        DirectGroup& group = system.direct[d];
        const std::uint32_t of = system.groupOfDirect(d);
        if (!isWatched(system, group) || system.thrownGroups[of] != 0 || system.flatGroups[of] != 0) continue;
        const std::uint32_t island = islands.islandOf[group.rows.front()];
        const bool isAlone = island == Islands::kNone;
        const real known = (isAlone ? real(0) : fastest[island]) + driven;
        const real bound = kThrown * (known + driveOf(system, group)) + context.lengthUnit;
        const bool within = std::all_of(group.rows.begin(), group.rows.end(), [&](std::uint32_t row) {
            return speedOf(motions[row], after[row]) <= bound;
        });
        const bool counts = !isAlone && (group.loops || system.touchedGroups[of] != 0);
        if (within && !(counts && world.energies[island].isMade(context, group.loops))) continue;
        if (!system.wholeGroups[of] && project(world, system, group, before, after)) {
            system.thrownGroups[of] = 1;  // for when all passes are over
            for (std::size_t k = 0; k < group.joints.size(); ++k)
                system.joints[group.joints[k]] = system.projection.begun[k];
            continue;
        }
        const bool softens = mayBeSoftened(system, of);
        forgetLoads(joints, motions, system, group, softens, before);
        system.anewGroups[of] = 1;
        if (softens)
            soften(system, d);
        else
            system.flatGroups[of] = 1;
        thrown = true;
    }
    return thrown;
}

// What contacts of groups that begin anew carry answers to what their joints carried: it is forgotten, too.
void forgetContacts(SolverStage& stage, std::vector<std::uint32_t>& forgotten)
{
    const Table<Motion>& motions = stage.motions.rows;
    Table<LaneRow>& before = stage.scratch.before;
    const auto isAnew = [&](std::uint32_t row) {
        return stage.system.isTied(row) && stage.system.anewGroups[stage.system.groupOf[row]] != 0;
    };
    forgotten.clear();
    for (std::uint32_t i = 0; i < stage.contacts.rows.size(); ++i) {
        Contact& c = stage.contacts.rows[i];
        if (c.count == 0 || (!isAnew(c.rowA) && !isAnew(c.rowB))) continue;
        stage.scratch.passes.takeOut(i, stage.contacts, stage.motions);
        forgotten.push_back(i);
        Motion a = motions[c.rowA], b = motions[c.rowB];
        a.steady = b.steady = {};
        a.steadySpin = b.steadySpin = 0;
        addLoad(loadOf(c), a, b);
        const auto takeBack = [&](std::uint32_t row, const Motion& m) {
            if (!m.moves()) return;
            before[row].x -= m.steady.x, before[row].y -= m.steady.y, before[row].z -= m.steadySpin;
        };
        takeBack(c.rowA, a);
        takeBack(c.rowB, b);
        for (int k = 0; k < c.count; ++k) c.points[k].normalImpulse = c.points[k].tangentImpulse = 0;
        c.rollingImpulse = 0;
    }
}

// Nothing pulls at their bodies any more: they have their own moments of inertia again, and spins of the same
// energy.
void releaseAnew(SolverStage& stage)
{
    JointSystem& system = stage.system;
    Table<Motion>& motions = stage.motions.rows;
    for (const std::uint32_t row : system.guarded) {
        if (system.anewGroups[system.groupOf[row]] == 0 || !system.isGuarded(row, motions[row])) continue;
        const real own = system.ownInvInertia[row], faster = std::sqrt(own / motions[row].invInertia);
        stage.scratch.before[row].z *= faster;
        stage.scratch.rows.changes[row].spin *= faster;
        motions[row].invInertia = own;
    }
    for (JointRows& joint : system.joints)
        if (system.anewGroups[joint.group] != 0) prepareRows(joint, motions);
}

// All bodies as they were before the passes; groups that begin anew without what they carry.
void goBack(SolverStage& stage)
{
    SolverScratch& scratch = stage.scratch;
    Table<Motion>& motions = stage.motions.rows;
    scratch.passes.restore(stage.contacts);
    std::vector<std::uint32_t>& forgotten = scratch.forgotten;
    forgetContacts(stage, forgotten);
    releaseAnew(stage);
    scratch.rows.velocities = scratch.before;
    for (std::size_t i = 0; i < motions.size(); ++i) setVelocity(motions[i], velocityOf(scratch.before[i]));
    for (const std::uint32_t i : forgotten) {
        Contact& c = stage.contacts.rows[i];
        prepareContact(c, motions[c.rowA], motions[c.rowB]);
    }
    if (!forgotten.empty()) scratch.passes.keep(stage.contacts);
}

// What joints of flat groups ask for, whatever the passes find.
void flatten(JointSystem& system, const StepContext& context)
{
    for (JointRows& joint : system.joints) {
        if (system.flatGroups[joint.group] == 0) continue;
        system.lostGroups[joint.group] = 1;
        flattenRows(joint, context);
    }
}

}  // namespace

void passOver(SolverStage& stage, const JointWorld& world)
{
    SolverScratch& scratch = stage.scratch;
    JointSystem& system = stage.system;
    const bool watches = isAnyWatched(system);
    if (mayProject(system)) scratch.before = scratch.rows.velocities;
    system.thrownGroups.assign(system.wholeGroups.size(), 0);
    system.flatGroups.assign(system.wholeGroups.size(), 0);
    if (watches) scratch.passes.keep(stage.contacts);
    const real surface = watches ? fastestSurface(stage.contacts) : real(0);
    for (;;) {
        if (!system.empty())
            startJoints(stage.joints, stage.world.bodies, stage.motions, world.context, system);
        flatten(system, world.context);
        scratch.passes.solve(stage.contacts, stage.motions, scratch.rows, world.context, &world, &system);
        if (!watches ||
            !softenThrown(world, stage.joints, system, surface, scratch.before, scratch.rows.velocities))
            return;
        goBack(stage);
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
