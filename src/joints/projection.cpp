// SPDX-License-Identifier: MIT
// Newton's method on the place where all joints of a group hold. Their impulses act along the directions that
// they have there, not where the tick begins: so they are a projection, which cannot throw what it brings.

#include "joints/projection.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>
#include <cmath>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr int kMostRounds = 30;
constexpr real kMostTurn = real(0.5);  // of a body, or of a tie at a distance, in a round   [rad]
constexpr real kExact = real(1e-5);  // of the bodies' extent: an error, or a way, that is none
constexpr real kNear = real(1e-2);  // the same of a way that comes to rest slowly
constexpr int kPatience = 8;  // rounds that it is given
constexpr double kGives = 0.9;  // of a moment of inertia: forces that drive a turn take no more of it
constexpr double kMade = 1e-3;  // of the kinetic energy: what joints may make of it

bool isPassive(const ConstraintRow& row)
{
    return row.kind == RowKind::Rigid || row.kind == RowKind::Limit;
}

class GroupProjection {
public:
    GroupProjection(const JointTable& table, const BodyTable& bodies, const MotionTable& motions,
                    const StepContext& context, JointSystem& system, DirectGroup& group)
        : table_(table), bodies_(bodies), motions_(motions.rows), context_(context), system_(system),
          group_(group), on_(system.projection)
    {
    }

    bool run(std::vector<BodyMotion<real>>& velocities);

private:
    const JointTable& table_;
    const BodyTable& bodies_;
    const Table<Motion>& motions_;
    const StepContext& context_;
    JointSystem& system_;
    DirectGroup& group_;
    ProjectionScratch& on_;

    std::size_t count() const { return group_.joints.size(); }
    JointRows& joint(std::size_t k) { return system_.joints[group_.joints[k]]; }
    real& impulse(std::size_t k, int i)
    {
        return on_.impulses[k * JointRows::kMost + static_cast<std::size_t>(i)];
    }
    BodyPair groundAt(std::size_t k);
    BodyPair pairAt(std::size_t k, const std::vector<BodyMotion<real>>& velocities);
    real returnOf(const JointRows& rows, const ConstraintRow& row) const;
    real aim();
    real aimJoint(std::size_t k);
    void resistTurning();
    real step();
    real farthestTurn();
    void applyImpulses(std::vector<BodyMotion<real>>& velocities);
    void finish(bool exact);
    double energyOf(const std::vector<BodyMotion<real>>& velocities) const;
    double allowance();
};

// The bodies of a joint with the velocities of what nothing can push only.
BodyPair GroupProjection::groundAt(std::size_t k)
{
    const Motion &a = motions_[joint(k).rowA], &b = motions_[joint(k).rowB];
    const auto [nodeA, nodeB] = group_.nodes[k];
    BodyPair pair{a, b, {}, {}};
    if (nodeA < 0) pair.va = {a.velocity, a.spin};
    if (nodeB < 0) pair.vb = {b.velocity, b.spin};
    return pair;
}

// And with velocities of the others, by node.
BodyPair GroupProjection::pairAt(std::size_t k, const std::vector<BodyMotion<real>>& velocities)
{
    BodyPair pair = groundAt(k);
    const auto [nodeA, nodeB] = group_.nodes[k];
    if (nodeA >= 0) pair.va = velocities[static_cast<std::size_t>(nodeA)];
    if (nodeB >= 0) pair.vb = velocities[static_cast<std::size_t>(nodeB)];
    return pair;
}

// How much of its error a row is to take back in the tick.
real GroupProjection::returnOf(const JointRows& rows, const ConstraintRow& row) const
{
    const real most = kReturn * (row.angular ? real(1) : context_.lengthUnit) * context_.h;
    const real error = row.kind == RowKind::Limit ? minimum(row.error, real(0)) : row.error;
    return clamp(rows.mildly ? kMildFade * error : error, -most, most);
}

// Asks all rows for what is left of their errors where the bodies are aimed at; returns the greatest, as a
// part of the bodies' extent.
real GroupProjection::aim()
{
    real most = 0;
    for (std::size_t k = 0; k < count(); ++k) {
        most = maximum(most, aimJoint(k));
        prepareRows(joint(k), motions_);
    }
    return most;
}

// What is solved for is a change of the velocities aimed at.
real GroupProjection::aimJoint(std::size_t k)
{
    const BodyPair pair = pairAt(k, on_.aimed), ground = groundAt(k);
    JointRows& rows = joint(k);
    JointRows base = on_.begun[k];
    const JointRows ahead = jointAhead(table_.rows[rows.joint], bodies_, pair, context_);
    aimRows(base, ahead, pair, context_);
    rows.armA = ahead.armA;
    rows.armB = ahead.armB;
    rows.across = ahead.across;
    rows.distance = ahead.distance;
    const real reach = maximum(rows.reach, rows.distance);
    real most = 0;
    for (int i = 0; i < rows.count; ++i) {
        ConstraintRow& row = rows.rows[i];
        RowVisit& visit = rows.visits[i];
        visit = base.visits[i];
        visit.soft = false;
        visit.impulse = impulse(k, i);
        if (!isPassive(row)) {  // a motor, a spring: as the tick begins
            const real speed = speedOf(base, i, pair) - speedOf(base, i, ground);
            visit.bias += speed;
            visit.push += visit.give * speed;
            continue;
        }
        const bool open = row.kind == RowKind::Limit && row.error > 0;
        const real kept = open ? real(0) : row.error - returnOf(rows, row);
        const real error = ahead.rows[i].error - kept;
        const bool holds = row.kind == RowKind::Rigid || error < 0 || impulse(k, i) > 0;
        if (holds) most = maximum(most, row.angular ? absolute(error) : absolute(error) / reach);
        row.j = ahead.rows[i].j;
        visit.bias = error * context_.invH - speedOf(rows, i, ground);
    }
    return most;
}

// As bodies turn, so do the directions of the forces on them: what resists that.
void GroupProjection::resistTurning()
{
    const double h = static_cast<double>(context_.h);
    std::vector<double>& stiffness = group_.turnStiffness;
    stiffness.assign(group_.rows.size(), 0);
    for (std::size_t k = 0; k < count(); ++k) {
        JointRows& rows = joint(k);
        Vec2 onA, onB;
        for (int i = 0; i < rows.count; ++i) {
            if (!isPassive(rows.rows[i])) continue;
            onA += impulse(k, i) * rows.rows[i].j.linearA;
            onB += impulse(k, i) * rows.rows[i].j.linearB;
        }
        const auto [a, b] = group_.nodes[k];
        if (a >= 0) stiffness[static_cast<std::size_t>(a)] += h * static_cast<double>(dot(rows.armA, onA));
        if (b >= 0) stiffness[static_cast<std::size_t>(b)] += h * static_cast<double>(dot(rows.armB, onB));
        const real pull = dot(onB, perpendicular(rows.across.linearB));
        rows.turnMass = rows.distance > 0 ? maximum(real(0), context_.h * pull / rows.distance) : real(0);
    }
    for (std::size_t n = 0; n < stiffness.size(); ++n) {
        const double inverse = static_cast<double>(motions_[group_.rows[n]].invInertia);
        stiffness[n] = maximum(stiffness[n], inverse > 0 ? -kGives / inverse : 0.0);
    }
}

// By how much the solved change turns something in the tick.   [rad]
real GroupProjection::farthestTurn()
{
    real turn = 0;
    for (const BodyMotion<real>& change : on_.solved) turn = maximum(turn, absolute(change.spin));
    for (std::size_t k = 0; k < count(); ++k) {
        const JointRows& rows = joint(k);
        if (!(rows.turnMass > 0)) continue;
        const BodyPair pair = pairAt(k, on_.solved), ground = groundAt(k);
        const real speed =
            speedAlong(rows.across, pair.va, pair.vb) - speedAlong(rows.across, ground.va, ground.vb);
        turn = maximum(turn, absolute(speed) / rows.distance);
    }
    return context_.h * turn;
}

// Solves for what was asked, and goes there as far as it can be trusted. Returns how far that would be in
// the tick, as a part of the bodies' extent, or a negative number.
real GroupProjection::step()
{
    resistTurning();
    group_.begins = true;
    on_.solved.resize(on_.aimed.size());
    for (std::size_t n = 0; n < on_.aimed.size(); ++n)
        on_.solved[n] = {on_.free[n].velocity - on_.aimed[n].velocity, on_.free[n].spin - on_.aimed[n].spin};
    applyImpulses(on_.solved);
    if (solveDirect(group_, system_.joints, motions_, on_.solved) < 0) return -1;
    const real turn = farthestTurn(), part = turn > kMostTurn ? kMostTurn / turn : real(1);
    real most = 0;
    for (std::size_t n = 0; n < on_.solved.size(); ++n) {
        const BodyMotion<real>& change = on_.solved[n];
        const real extent = motions_[group_.rows[n]].extent;
        most = maximum(most, length(change.velocity) + absolute(change.spin) * extent);
        on_.aimed[n].velocity += part * change.velocity;
        on_.aimed[n].spin += part * change.spin;
    }
    real reach = 0;
    for (std::size_t k = 0; k < count(); ++k) {
        reach = maximum(reach, maximum(joint(k).reach, joint(k).distance));
        for (int i = 0; i < joint(k).count; ++i)
            impulse(k, i) += part * (joint(k).visits[i].impulse - impulse(k, i));
    }
    return reach > 0 ? context_.h * most / reach : -1;
}

// Adds what the impulses so far do.
void GroupProjection::applyImpulses(std::vector<BodyMotion<real>>& velocities)
{
    for (std::size_t k = 0; k < count(); ++k) {
        BodyPair pair = pairAt(k, velocities);
        for (int i = 0; i < joint(k).count; ++i) applyTo(joint(k), i, impulse(k, i), pair);
        const auto [a, b] = group_.nodes[k];
        if (a >= 0) velocities[static_cast<std::size_t>(a)] = pair.va;
        if (b >= 0) velocities[static_cast<std::size_t>(b)] = pair.vb;
    }
}

// The velocities are what the impulses make of those without joints: what resisted is gone.
void GroupProjection::finish(bool exact)
{
    if (exact) {
        on_.aimed = on_.free;
        applyImpulses(on_.aimed);
    }
    for (std::size_t k = 0; k < count(); ++k) {
        joint(k).turnMass = 0;
        for (int i = 0; i < joint(k).count; ++i) joint(k).visits[i].impulse = impulse(k, i);
    }
}

// Kinetic, of the group.   [J]
double GroupProjection::energyOf(const std::vector<BodyMotion<real>>& velocities) const
{
    double energy = 0;
    const auto add = [&](real speed, real inverse) {
        const double s = static_cast<double>(speed);
        if (inverse > 0) energy += s * s / (2 * static_cast<double>(inverse));
    };
    for (std::size_t n = 0; n < velocities.size(); ++n) {
        const Motion& m = motions_[group_.rows[n]];
        add(velocities[n].velocity.x, m.invMass.x);
        add(velocities[n].velocity.y, m.invMass.y);
        add(velocities[n].spin, m.invInertia);
    }
    return energy;
}

// What springs, motors and moving grounds may add to it, and at most the return of errors.   [J]
double GroupProjection::allowance()
{
    double driven = 0, returned = 0, mass = 0;
    for (std::size_t k = 0; k < count(); ++k) {
        const JointRows& rows = joint(k);
        const BodyPair first = pairAt(k, on_.free), last = pairAt(k, on_.aimed), ground = groundAt(k);
        for (int i = 0; i < rows.count; ++i) {
            const ConstraintRow& row = rows.rows[i];
            const real ofGround = speedOf(rows, i, ground);
            const real speed = (speedOf(rows, i, first) + speedOf(rows, i, last)) / 2 - ofGround;
            driven +=
                static_cast<double>(impulse(k, i)) * static_cast<double>(isPassive(row) ? -ofGround : speed);
            if (!isPassive(row)) continue;
            const real reach = row.angular ? rows.reach : real(1);
            returned += static_cast<double>(absolute(returnOf(rows, row)) * reach * context_.invH);
        }
    }
    for (const std::uint32_t row : group_.rows) {
        const double inverse = static_cast<double>(motions_[row].greatestInvMass());
        if (inverse > 0) mass += 1 / inverse;
    }
    return driven + mass * returned * returned / 2;
}

bool GroupProjection::run(std::vector<BodyMotion<real>>& velocities)
{
    on_.begun.clear();
    for (std::size_t k = 0; k < count(); ++k) on_.begun.push_back(joint(k));
    on_.impulses.assign(count() * JointRows::kMost, 0);
    on_.free = on_.aimed = velocities;
    bool found = false, exact = false;
    for (int round = 0; round < kMostRounds && !found; ++round) {
        const real left = aim(), way = step();
        if (!(way >= 0) || !std::isfinite(way)) break;
        exact = left <= kExact && way <= kExact;
        found = exact || (round >= kPatience && left <= kExact && way <= kNear);
    }
    group_.turnStiffness.clear();
    group_.begins = true;
    if (found) finish(exact);
    const double begun = energyOf(on_.free);
    if (found && energyOf(on_.aimed) <= begun + kMade * begun + allowance()) {
        velocities = on_.aimed;
        return true;
    }
    for (std::size_t k = 0; k < count(); ++k) joint(k) = on_.begun[k];
    return false;
}

}  // namespace

bool mayBeProjected(const JointSystem& system, const DirectGroup& group)
{
    if (group.joints.empty()) return false;
    const std::uint32_t of = system.joints[group.joints.front()].group;
    if (system.touchedGroups[of] || system.piledGroups[of]) return false;
    return std::none_of(group.joints.begin(), group.joints.end(),
                        [&](std::uint32_t j) { return system.joints[j].own; });
}

bool projectGroup(const JointTable& table, const BodyTable& bodies, const MotionTable& motions,
                  const StepContext& context, JointSystem& system, DirectGroup& group,
                  std::vector<BodyMotion<real>>& velocities)
{
    return GroupProjection(table, bodies, motions, context, system, group).run(velocities);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
