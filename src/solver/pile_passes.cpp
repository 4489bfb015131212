// SPDX-License-Identifier: MIT
// A tick of the piles that are solved at once: the passes over them, what they carry on, and the push.

#include "contacts/rows.hpp"
#include "solver/direct_contacts.hpp"
#include "solver/stiff_piles.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr std::size_t kMostBlocks = 200;  // of the factors of a pile: beyond, solving it costs too much
constexpr double kNegligible = 1e-5;        // a speed at which nothing moves   [lengthUnit/s]

}  // namespace

bool StiffPiles::pass(std::size_t first, bool anew, ContactTable& contacts, const JointWorld& world,
                      JointSystem& joints, Table<LaneRow>& velocities, std::vector<std::uint8_t>& unrest)
{
    const real restless = world.context.tuning.restless * world.context.lengthUnit;
    bool left = false;
    for (std::size_t p = first; p < count_; ++p) {
        StiffPile& pile = piles_[p];
        if (pile.failed) continue;
        if (anew)
            start(pile, contacts, world, joints, velocities);
        else if (!pile.restless)
            continue;
        for (const std::uint32_t j : pile.group.joints) aimJoint(world, velocities, joints.joints[j]);
        const real change = visit(pile, contacts, world, joints, velocities);
        pile.restless = change > restless && (pile.failed || !pile.group.joints.empty());
        left = left || pile.restless;
        if (!pile.failed) continue;
        for (const std::uint32_t row : pile.group.rows) unrest[world.islands.islandOf[row]] = 1;
    }
    return left;
}

// The rows of a tick.
void StiffPiles::start(StiffPile& pile, const ContactTable& contacts, const JointWorld& world,
                       JointSystem& joints, Table<LaneRow>& velocities)
{
    const Table<Motion>& motions = world.motions.rows;
    pile.group.begins = true;
    pile.group.negligible = kNegligible * static_cast<double>(world.context.lengthUnit);
    pile.group.contacts.clear();
    pile.places.clear();
    pile.carried.clear();
    for (const std::uint32_t i : pile.contacts) {
        const Contact& c = contacts.rows[i];
        pile.carried.push_back({c.points[0].normalImpulse, c.points[1].normalImpulse});
        pile.group.contacts.push_back(directRowsOf(c, motionWith(motions[c.rowA], velocities[c.rowA]),
                                                   motionWith(motions[c.rowB], velocities[c.rowB]),
                                                   world.context, pile.places));
    }
    pile.group.build(joints.joints, motions);
    for (const std::uint32_t j : pile.group.joints) joints.joints[j].mildly = pile.group.loops;
}

real StiffPiles::visit(StiffPile& pile, ContactTable& contacts, const JointWorld& world, JointSystem& joints,
                       Table<LaneRow>& velocities)
{
    DirectGroup& group = pile.group;
    const Table<Motion>& motions = world.motions.rows;
    own_.clear();
    for (const std::uint32_t row : group.rows) own_.push_back(velocityOf(velocities[row]));
    before_ = own_;
    kept_.clear();
    for (const std::uint32_t j : group.joints) kept_.push_back(joints.joints[j]);
    const bool small = group.matrix.fill() <= kMostBlocks;
    real change = small ? solveDirect(group, joints.joints, motions, own_) : real(-1);
    if (change >= 0 && isThrown(pile, before_, world, joints)) change = -1;
    if (change >= 0) {
        for (std::size_t n = 0; n < group.rows.size(); ++n) setVelocity(velocities[group.rows[n]], own_[n]);
        const std::uint8_t* place = pile.places.data();
        for (std::size_t k = 0; k < pile.contacts.size(); ++k)
            storeDirectRows(group.contacts[k], place, contacts.rows[pile.contacts[k]]);
        return change;
    }
    return disband(pile, contacts, world, joints, velocities);
}

// An answer that is faster than all that is known is none: pulled straight, next to nothing holds the rows of
// joints apart.
bool StiffPiles::isThrown(const StiffPile& pile, const std::vector<BodyMotion<real>>& before,
                          const JointWorld& world, const JointSystem& joints) const
{
    constexpr real kThrown = 4;  // times the fastest so far
    const Table<Motion>& motions = world.motions.rows;
    const auto speedOf = [&](const BodyMotion<real>& v, std::uint32_t row) {
        return length(v.velocity) + absolute(v.spin) * motions[row].extent;
    };
    real fastest = 0;
    for (std::size_t n = 0; n < before.size(); ++n)
        fastest = maximum(fastest, speedOf(before[n], pile.group.rows[n]));
    const real drive = drivenSpeed(motions) + driveOf(joints, pile.group);
    fastest += drive;
    for (std::size_t n = 0; n < own_.size(); ++n)
        if (!(speedOf(own_[n], pile.group.rows[n]) <= kThrown * fastest + world.context.lengthUnit))
            return true;
    const auto isUneven = [&](std::uint32_t j) { return joints.joints[j].uneven; };
    if (!pile.group.loops || std::any_of(pile.group.joints.begin(), pile.group.joints.end(), isUneven))
        return false;
    TickEnergy energy{.drive = drive};
    for (const JointRows& contact : pile.group.contacts)
        for (int i = 0; i < contact.count; ++i)
            if (contact.rows[i].pressedBy != 0)
                energy.drive = maximum(energy.drive, drive + absolute(contact.visits[i].bias));
    for (std::size_t n = 0; n < own_.size(); ++n) {
        const std::uint32_t row = pile.group.rows[n];
        energy.add(world.rows, motions[row], row, own_[n]);
    }
    return energy.isMade(world.context, true);
}

// No solution: what is tied and touches is visited one by one, softly, for the rest of the step, and not
// tried again for some. Returns what the first of these visits changed.
real StiffPiles::disband(StiffPile& pile, ContactTable& contacts, const JointWorld& world,
                         JointSystem& joints, Table<LaneRow>& velocities)
{
    const Table<Motion>& motions = world.motions.rows;
    const DirectGroup& group = pile.group;
    ++fallbacks_;
    pile.failed = true;
    real change = 0;
    for (std::size_t k = 0; k < group.joints.size(); ++k) {
        JointRows& joint = joints.joints[group.joints[k]];
        joint = kept_[k];
        joints.piledGroups[joint.group] = 0;
        joints.isAltered = true;
        for (std::size_t d = joints.directCount; joints.stiffGroups[joint.group] && d-- > 0;)
            if (joints.joints[joints.direct[d].joints.front()].group == joint.group) soften(joints, d);
        joint.rigidly = joint.mildly = false;
        aimJoint(world, velocities, joint);
        change = maximum(change, visitJoint(joint, motions, velocities));
    }
    for (const std::uint32_t i : pile.contacts) {
        Contact& c = contacts.rows[i];
        Motion a = motionWith(motions[c.rowA], velocities[c.rowA]),
               b = motionWith(motions[c.rowB], velocities[c.rowB]);
        change = maximum(change, solveContact(c, a, b, world.context));
        setVelocity(velocities[c.rowA], velocityOf(a));
        setVelocity(velocities[c.rowB], velocityOf(b));
    }
    return change;
}

void StiffPiles::forgetBlows(ContactTable& contacts, const MotionTable& motions, const StepContext& context)
{
    for (std::size_t p = 0; p < count_; ++p) {
        StiffPile& pile = piles_[p];
        for (std::size_t k = 0; k < pile.carried.size(); ++k) {
            Contact& c = contacts.rows[pile.contacts[k]];
            const Motion &a = motions.rows[c.rowA], &b = motions.rows[c.rowB];
            const real inverse = maximum(a.greatestInvMass(), b.greatestInvMass());
            const real own = maximum(context.h * maximum(length(a.acceleration), length(b.acceleration)),
                                     context.tuning.restless * context.lengthUnit);
            for (int i = 0; i < c.count; ++i) {
                ContactPointRow& point = c.points[i];
                const real carried = pile.carried[k][static_cast<std::size_t>(i)];
                const real most = inverse > 0 ? 2 * (carried + own / inverse) : kUnlimited;
                if (point.normalImpulse > most) {
                    point.tangentImpulse *= most / point.normalImpulse;
                    point.normalImpulse = most;
                }
                // Its bound was that of the normal impulse before the last.
                const real bound = c.friction * point.normalImpulse;
                point.tangentImpulse = clamp(point.tangentImpulse, -bound, bound);
            }
        }
        if (pile.failed) pile.carried.clear();
    }
}

// All overlaps at once, through whatever lies between; what joints tie stays together.
void StiffPiles::pushApart(ContactTable& contacts, const JointWorld& world, const JointSystem& joints,
                           Table<LaneRow>& pushes, ClampCounts& clamps)
{
    const Table<Motion>& motions = world.motions.rows;
    const std::vector<JointRows> none;
    for (std::size_t p = 0; p < count_; ++p) {
        StiffPile& pile = piles_[p];
        if (pile.failed) continue;
        DirectGroup& group = pile.push;
        group.contacts.clear();
        bool any = false;
        for (const std::uint32_t i : pile.contacts) {
            Contact& c = contacts.rows[i];
            c.pushed = 0;
            group.contacts.push_back(
                pushRowsOf(c, motions[c.rowA], motions[c.rowB], world.context, clamps, any));
        }
        if (!any) continue;
        for (const std::uint32_t j : pile.group.joints) {
            JointRows rows = joints.joints[j];
            rows.count = rows.rigid;
            rows.turnMass = 0;
            for (int i = 0; i < rows.count; ++i) rows.visits[i] = {.low = -kUnlimited, .high = kUnlimited};
            group.contacts.push_back(rows);
        }
        std::vector<JointRows> all;
        group.build(all, motions);
        own_.assign(group.rows.size(), {});
        if (solveDirect(group, all, motions, own_) < 0) continue;
        for (std::size_t n = 0; n < group.rows.size(); ++n) setVelocity(pushes[group.rows[n]], own_[n]);
        for (std::size_t k = 0; k < pile.contacts.size(); ++k)
            for (int i = 0; i < group.contacts[k].count; ++i)
                contacts.rows[pile.contacts[k]].pushed += group.contacts[k].visits[i].impulse;
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
