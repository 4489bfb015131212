// SPDX-License-Identifier: MIT
// What the passes leave restless because heavy bodies press light ones becomes a pile: docs/theory/joints.md,
// section 8.
#include "solver/contact_passes.hpp"

#include "contacts/rows.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {

// Contacts that press a light body and still close, faster than what is restless; if that is tied to a heavy
// one all of them, as the joints have their visits first.
void ContactPasses::findCrushing(const ContactTable& contacts, const MotionTable& motions,
                                 const TickRows& rows, const StepContext& context)
{
    using Lightness = StiffPiles::Lightness;
    const real restless = context.tuning.restless * context.lengthUnit;
    list_.clear();
    if (std::none_of(unrest_.begin(), unrest_.end(), [](std::uint8_t is) { return is != 0; })) return;
    for (std::uint32_t i = 0; i < contacts.rows.size(); ++i) {
        const Contact& c = contacts.rows[i];
        if (c.count == 0 || !holds(i) || unrest_[islandOf(*islands_, c.rowA, c.rowB)] == 0) continue;
        const Lightness light = piles_.crushes(c);
        if (light == Lightness::None) continue;
        if (light == Lightness::Tied || closing(i, c, motions, rows, context) > restless) list_.push_back(i);
    }
}

// How much faster than they may points of the contact still close, that no impact is to stop.
real ContactPasses::closing(std::uint32_t contact, const Contact& c, const MotionTable& motions,
                            const TickRows& rows, const StepContext& context) const
{
    const LaneRow &a = rows.velocities[c.rowA], &b = rows.velocities[c.rowB];
    const bool inLane = isInLane(contact);
    const LaneView lane = inLane ? view(contact) : LaneView{};
    const Vec2 n = inLane ? lane.normal : c.normal;
    const Motion motionA = motionWith(motions.rows[c.rowA], a), motionB = motionWith(motions.rows[c.rowB], b);
    real most = 0;
    for (int k = 0; k < c.count; ++k) {
        const ContactPointRow& p = c.points[k];
        if (!inLane && isLeftToImpacts(c, k, motionA, motionB, context)) continue;
        const real turnA = inLane ? lane.points[k].turnA : cross(p.armA, n);
        const real turnB = inLane ? lane.points[k].turnB : cross(p.armB, n);
        const real gap = inLane ? lane.points[k].gap : p.gap;
        const real speed = dot(n, motionB.velocity - motionA.velocity) + turnB * b.z - turnA * a.z;
        most = maximum(most, -speed - maximum(gap, real(0)) * context.invH);
    }
    return most;
}

void ContactPasses::finish(ContactTable& contacts, const MotionTable& motions, TickRows& rows,
                           const JointWorld* world, JointSystem* joints)
{
    list_.clear();
    const std::size_t first = piles_.count();
    if (joints != nullptr && piles_.mayCrush()) findCrushing(contacts, motions, rows, world->context);
    if (joints != nullptr && !list_.empty() && piles_.add(list_, contacts, *joints) > 0) {
        for (std::size_t p = first; p < piles_.count(); ++p)
            for (const std::uint32_t i : piles_[p].contacts)
                if (isInLane(i)) takeOut(i, contacts, motions);
        for (int pass = 0; pass <= world->context.tuning.extraPasses; ++pass)
            if (!piles_.pass(first, pass == 0, contacts, *world, *joints, rows.velocities, unrest_)) break;
        sortLoose();
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
