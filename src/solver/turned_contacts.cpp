// SPDX-License-Identifier: MIT
// The rows of a contact are lines through where its bodies are as a tick begins. What a joint whirls about
// leaves them within the tick, and lies in the wall at its end.

#include "solver/turned_contacts.hpp"

#include "contacts/rows.hpp"
#include "contacts/update.hpp"
#include "joints/pose.hpp"
#include "narrowphase/swept.hpp"
#include "solver/integrate.hpp"
#include "solver/tick_sweeps.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// What a body may turn in a tick, or leave the way it was to go by, as a part of its extent, before its
// contacts are looked at.
constexpr real kMuch = real(0.05);

class TurnedContacts {
public:
    TurnedContacts(ImpactStage& stage, const StepContext& context, real restGaps)
        : stage_(stage), context_(context), restGaps_(restGaps)
    {
    }

    // Does a body stray so far?
    bool strays(std::uint32_t row) const
    {
        const JointSystem& system = stage_.system;
        const std::uint32_t group = system.groupOf[row];
        if (group == JointSystem::kNone) return false;
        const Motion& m = motion(row);
        if (!m.moves()) return false;
        if (system.lostGroups[group] != 0) return true;
        const BodyMotion<real> now = velocityAt(row), before = velocityOf(stage_.rows.starts[row]);
        const Vec2 aside = now.velocity - before.velocity;
        const real shift = absolute(aside.x) + absolute(aside.y);
        return context_.h * absolute(now.spin) > kMuch || context_.h * shift > kMuch * m.extent;
    }

    // Which islands have a body that is faster than any may be.
    void findWild(std::vector<std::uint8_t>& wild) const
    {
        wild.assign(stage_.islands.count(), 0);
        for (std::size_t i = 0; i < stage_.motions.rows.size(); ++i)
            if (stage_.system.isTied(i) && motion(i).moves() && !isTame(velocityAt(i)))
                wild[stage_.islands.islandOf[i]] = 1;
    }

    // Aims the contact if it has to be; returns whether it had.
    bool aim(std::uint32_t i)
    {
        const Contact& known = stage_.contacts.rows[i];
        const Motion &a = motion(known.rowA), &b = motion(known.rowB);
        const Position origin = originOf(a, b);
        const SweptPair pair{stage_.world.shapes.convex(known.shapeA),
                             stage_.world.shapes.convex(known.shapeB), pathOf(known.rowA, origin),
                             pathOf(known.rowB, origin), known.restGap};
        const SweptResult result = collideSwept(pair, 0, context_.h);
        if (!result.near || result.manifold.count == 0) return false;
        Contact met = known;
        adoptManifold(met, result, 0);
        placeContact(met, a, b);
        const real atStart = minimum(leastGap(met), real(0));
        const Motion endA = atEnd(known.rowA), endB = atEnd(known.rowB);
        placeContact(met, endA, endB);
        if (!(leastGap(met) < atStart - restGaps_ * known.restGap)) return false;

        stage_.passes.takeOut(i, stage_.contacts, stage_.motions);
        Contact& c = stage_.contacts.rows[i];
        adoptManifold(c, result, 0);
        prepareContact(c, endA, endB);
        for (int k = 0; k < c.count; ++k) {
            ContactPointRow& point = c.points[k];
            const Vec2 speed =
                endB.velocity + cross(endB.spin, point.armB) - endA.velocity - cross(endA.spin, point.armA);
            point.gap -= context_.h * dot(c.normal, speed);
            point.wasLoaded = true;  // what is left of an impact is no impact
        }
        sweepFromNowOn(stage_, i);
        return true;
    }

private:
    ImpactStage& stage_;
    const StepContext& context_;
    const real restGaps_;

    const Motion& motion(std::size_t row) const { return stage_.motions.rows[row]; }
    BodyMotion<real> velocityAt(std::size_t row) const
    {
        return motion(row).moves() ? velocityOf(stage_.rows.velocities[row]) : velocityOf(motion(row));
    }
    // Slower than what the drift slows down; beyond that more passes end in values that are no numbers.
    bool isTame(const BodyMotion<real>& motion) const
    {
        const real most = mostSpeed(context_.lengthUnit);
        return absolute(motion.velocity.x) < most && absolute(motion.velocity.y) < most &&
               absolute(motion.spin) < mostSpin();
    }

    // The way to the end of the tick.
    Trajectory pathOf(std::uint32_t row, Position origin) const
    {
        const Motion& m = motion(row);
        const BodyMotion<real> way = velocityAt(row);
        Trajectory path{};
        path.position = toVec2(m.center - origin);
        path.angle = m.angle;
        path.rotation = m.rotation;
        path.velocity = way.velocity;
        path.spin = way.spin;
        return path;
    }

    // The body there.
    Motion atEnd(std::uint32_t row) const
    {
        Motion m = motion(row);
        setVelocity(m, velocityAt(row));
        const BodyPlace place = placeAhead(m, velocityOf(m), context_.h);
        m.center = place.center;
        m.angle = place.angle;
        m.rotation = place.rotation;
        return m;
    }

    real leastGap(const Contact& c) const
    {
        return c.count == 2 ? minimum(c.points[0].gap, c.points[1].gap) : c.points[0].gap;
    }
};

}  // namespace

bool aimTurnedContacts(ImpactStage& stage, const StepContext& context, real restGaps)
{
    TurnedScratch& turned = stage.scratch.turned;
    TurnedContacts contacts(stage, context, restGaps);
    turned.contacts.clear();
    bool any = false;
    for (std::uint32_t i = 0; i < stage.contacts.rows.size(); ++i) {
        const PairRow& pair = stage.scratch.pairs[i];
        if (!contacts.strays(pair.rowA) && !contacts.strays(pair.rowB)) continue;
        if (!any) {
            turned.islands.assign(stage.islands.count(), 0);
            contacts.findWild(turned.wild);
        }
        any = true;
        const std::uint32_t island = islandOf(stage.islands, pair.rowA, pair.rowB);
        if (turned.wild[island] != 0 || !contacts.aim(i)) continue;
        turned.islands[island] = 1;
        turned.contacts.push_back(i);
    }
    return !turned.contacts.empty();
}

namespace {

constexpr std::uint32_t kNone = JointSystem::kNone;

void forgetGrounds(const JointSystem& system, TurnedScratch& turned)
{
    turned.grounds.assign(system.wholeGroups.size(), kNone);
    turned.parts.assign(system.wholeGroups.size(), 1);
}

// If the contact is one of a group with a ground.
void noteGround(ImpactStage& stage, std::uint32_t contact)
{
    const Table<Motion>& motions = stage.motions.rows;
    const PairRow& pair = stage.scratch.pairs[contact];
    if (motions[pair.rowA].moves() == motions[pair.rowB].moves()) return;
    const bool onA = motions[pair.rowB].moves();
    const std::uint32_t group = stage.system.groupOf[onA ? pair.rowB : pair.rowA];
    if (group != kNone) stage.scratch.turned.grounds[group] = onA ? pair.rowA : pair.rowB;
}

// Groups that have a ground go by their part against it.
std::uint32_t slowDown(ImpactStage& stage)
{
    const Table<Motion>& motions = stage.motions.rows;
    const TurnedScratch& turned = stage.scratch.turned;
    std::uint32_t slowed = 0;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const std::uint32_t group = stage.system.groupOf[i];
        if (group == kNone || turned.grounds[group] == kNone || !motions[i].moves()) continue;
        const real part = turned.parts[group];
        if (!(part < 1)) continue;
        const Motion& ground = motions[turned.grounds[group]];
        const Vec2 arm = toVec2(motions[i].center - ground.center);
        const BodyMotion<real> with{ground.velocity + cross(ground.spin, arm), ground.spin};
        LaneRow& row = stage.rows.velocities[i];
        ImpactKick& kick = stage.rows.kicks[i];
        if (part > 0) {
            const BodyMotion<real> now = velocityOf(row);
            setVelocity(row, {with.velocity + part * (now.velocity - with.velocity),
                              with.spin + part * (now.spin - with.spin)});
            kick.after = part * kick.after;
            kick.spinAfter *= part;
        } else {  // whatever it was
            setVelocity(row, with);
            kick = {};
        }
        ++slowed;
    }
    return slowed;
}

// By how much more a joint would be apart at the end of the tick than at its start.   [m]
real growthOf(const JointWorld& world, const Table<LaneRow>& velocities, const JointRows& joint)
{
    const Table<Motion>& rows = world.motions.rows;
    const BodyPair pair{rows[joint.rowA], rows[joint.rowB], velocityOf(velocities[joint.rowA]),
                        velocityOf(velocities[joint.rowB])};
    const JointRows ahead = jointAhead(world.joints.rows[joint.joint], world.bodies, pair, world.context);
    real most = 0;
    for (int i = 0; i < minimum(joint.count, ahead.count); ++i) {
        if (joint.rows[i].kind != RowKind::Rigid || joint.rows[i].angular) continue;
        most = maximum(most, absolute(ahead.rows[i].error) - absolute(joint.rows[i].error));
    }
    return most;
}

}  // namespace

std::uint32_t stopTurned(ImpactStage& stage)
{
    JointSystem& system = stage.system;
    TurnedScratch& turned = stage.scratch.turned;
    forgetGrounds(system, turned);
    for (const std::uint32_t i : turned.contacts) noteGround(stage, i);
    for (std::size_t group = 0; group < turned.grounds.size(); ++group) {
        if (turned.grounds[group] == kNone) continue;
        turned.parts[group] = 0;
        system.lostGroups[group] = 1;
    }
    for (JointRows& joint : system.joints) joint.lost = joint.lost || system.lostGroups[joint.group] != 0;
    return slowDown(stage);
}

std::uint32_t slowTorn(ImpactStage& stage, const JointWorld& world)
{
    constexpr real kMostTorn = real(2e-3);  // of its arms
    const JointSystem& system = stage.system;
    const std::vector<std::uint8_t>& lost = system.lostGroups;
    if (std::find(lost.begin(), lost.end(), std::uint8_t{1}) == lost.end()) return 0;
    TurnedScratch& turned = stage.scratch.turned;
    forgetGrounds(system, turned);
    for (const JointRows& joint : system.joints) {
        if (lost[joint.group] == 0 || joint.own) continue;
        const real most = kMostTorn * (length(joint.armA) + length(joint.armB));
        const real growth = growthOf(world, stage.rows.velocities, joint);
        if (!(growth > most)) continue;
        real& part = turned.parts[joint.group];
        part = minimum(part, squareRoot(most / growth));
    }
    for (std::uint32_t i = 0; i < stage.contacts.rows.size(); ++i)
        if (stage.contacts.rows[i].count > 0) noteGround(stage, i);
    return slowDown(stage);
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
