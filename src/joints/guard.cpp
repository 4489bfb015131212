// SPDX-License-Identifier: MIT
// Light bodies between heavy loads, and ties at a distance: what resists their turning in a tick.
// docs/theory/joints.md, sections 5 and 7.

#include "joints/tick.hpp"

#include <tamias2d/math/scalar.hpp>

#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr real kStiff = 4;  // a body may turn by 1/sqrt(this) radians of its swing in a tick

// Another moment of inertia, and the spin that has the same energy with it: with the same spin, or the same
// angular momentum, each change would do work.
void takeInertia(Motion& m, real invInertia)
{
    if (m.invInertia > 0 && invInertia > 0) m.spin *= std::sqrt(invInertia / m.invInertia);
    m.invInertia = invInertia;
}

// What resists the turning of a tie at a distance in the tick [eq. 13]. `pull` is its impulse in the last
// one.
real turnMassOf(const JointRows& joint, real pull, const Motion& a, const Motion& b,
                const StepContext& context)
{
    constexpr real kOwn = real(0.1);  // of the lighter mass: up to there nothing is done
    const real inverse = maximum(a.greatestInvMass(), b.greatestInvMass());
    if (!(joint.distance > 0) || !(inverse > 0)) return 0;
    return maximum(real(0), context.h * pull / joint.distance - kOwn / inverse);
}

// What a joint pulls at its bodies, by the impulse of each row. Returns its impulse on B.
template <class ImpulseOf>
Vec2 addPull(const JointRows& joint, ImpulseOf impulseOf, std::vector<real>& pull)
{
    Vec2 onA, onB;
    for (int i = 0; i < joint.count; ++i) {
        onA += impulseOf(i) * joint.rows[i].j.linearA;
        onB += impulseOf(i) * joint.rows[i].j.linearB;
    }
    pull[joint.rowA] += length(joint.armA) * length(onA);
    pull[joint.rowB] += length(joint.armB) * length(onB);
    for (int k = 0; joint.more && k < joint.more->count; ++k) {
        Vec2 on;
        for (int i = 0; i < joint.count; ++i) on += impulseOf(i) * joint.more->parts[i][k].linear;
        pull[joint.more->rows[k]] += length(joint.more->arms[k]) * length(on);
    }
    return onB;
}

}  // namespace

bool guardLightBodies(const JointTable& table, JointSystem& system, Table<Motion>& rows,
                      const StepContext& context)
{
    for (JointRows& joint : system.joints) {
        const JointRow& carried = table.rows[joint.joint];
        const Vec2 onB =
            addPull(joint, [&](int i) { return carried.impulses[joint.rows[i].slot]; }, system.pull);
        joint.turnMass = turnMassOf(joint, dot(onB, perpendicular(joint.across.linearB)), rows[joint.rowA],
                                    rows[joint.rowB], context);
    }
    constexpr real kMostGuard = real(1e12);  // times its own inertia: whatever pulls, it can be turned
    bool changed = false;
    const real share = kStiff * context.h;
    const real *const own = system.ownInvInertia.data(), *const pull = system.pull.data();
    const auto guard = [&](std::uint32_t row) {
        const real needed = share * pull[row];
        const real used = own[row] * needed > 1 ? maximum(1 / needed, own[row] / kMostGuard) : own[row];
        if (used == rows[row].invInertia) return;
        changed = true;
        takeInertia(rows[row], used);
    };
    for (const std::uint32_t row : system.guarded) guard(row);
    system.guarded.clear();
    for (std::uint32_t row = 0; row < rows.size(); ++row) {
        if (!(own[row] * (share * pull[row]) > 1)) continue;
        guard(row);
        system.guarded.push_back(row);
    }
    if (changed)
        for (JointRows& joint : system.joints) prepareRows(joint, rows);
    return changed;
}

void releaseGuard(JointSystem& system, Table<Motion>& rows)
{
    for (const std::uint32_t row : system.guarded)
        if (rows[row].invInertia != system.ownInvInertia[row])
            takeInertia(rows[row], system.ownInvInertia[row]);
    system.guarded.clear();
}

void findOutgrown(JointSystem& system, const Table<Motion>& rows, const StepContext& context,
                  std::vector<std::uint8_t>& groups)
{
    constexpr real kOutgrown = 2;  // times what the tick was begun with
    if (system.directCount == 0) return;
    system.pull.assign(rows.size(), 0);
    for (const JointRows& joint : system.joints) {
        if (!system.stiffGroups[joint.group]) continue;
        const real part = joint.whole ? real(1) : real(2);
        const Vec2 onB = addPull(joint, [&](int i) { return part * joint.visits[i].impulse; }, system.pull);
        if (!(joint.distance > 0)) continue;
        const real inverse = maximum(rows[joint.rowA].greatestInvMass(), rows[joint.rowB].greatestInvMass());
        const real needed = context.h * dot(onB, perpendicular(joint.across.linearB)) / joint.distance;
        if (inverse > 0 && !(needed <= kOutgrown * (joint.turnMass + 1 / inverse))) groups[joint.group] = 1;
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::uint32_t group = system.groupOf[i];
        if (group == JointSystem::kNone || !system.stiffGroups[group]) continue;
        if (!(kStiff * context.h * system.pull[i] * rows[i].invInertia <= kOutgrown)) groups[group] = 1;
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
