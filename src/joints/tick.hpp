// SPDX-License-Identifier: MIT
// The joints' part of a tick, one call a stage. src/solver/solve.cpp has the order.
#pragma once

#include "joints/direct.hpp"
#include "joints/own.hpp"
#include "joints/pose.hpp"
#include "math/lane_rows.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What the projection of a group works with; it keeps its memory. By node, or by joint of the group.
struct ProjectionScratch {
    std::vector<BodyMotion<real>> free, aimed, solved;
    std::vector<JointRows> begun;
    std::vector<real> impulses;  // by joint and row
};

/// What lists of joints depend on of a body.
struct ListedRow {
    std::uint32_t body = 0;
    bool isDamped = false;
    Vec2 invMass;
    real invInertia = 0;

    bool operator==(const ListedRow&) const = default;
};

/// The joints at work in a step, each list in the order of its bodies; keeps its memory. The lists stay from
/// step to step while joints and rows do.
struct JointSystem {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr std::uint64_t kNeverListed = 0;

    std::uint64_t listing = kNeverListed;    // the number of the lists: others have another one
    bool isAltered = false;                  // are they to be made anew for the next step?
    std::uint64_t changes = 0;               // JointTable::changes when they were made
    std::vector<ListedRow> listed;           // by row, then

    std::vector<JointTie> ties;              // all of them
    std::vector<JointRows> joints;           // those that are visited one by one, or at once
    std::vector<JointTie> hinges;            // the others, which are left to lanes: HingeLanes
    std::vector<std::uint32_t> groupOf;      // by row: of the bodies that joints tie together; or kNone
    std::vector<std::uint8_t> stiffGroups;   // by group: solved at once
    std::vector<std::uint8_t> unevenGroups;  // by group: of masses that soft rows cannot be trusted with
    std::vector<std::uint8_t> piledGroups;   // by group: solved at once before the drift, with contacts
    std::vector<std::uint8_t> softenedGroups;  // by group: not to be solved at once any more in this step
    std::vector<std::uint8_t> pulledGroups;    // by group: has a target
    std::vector<std::uint8_t> lanedGroups;     // by group: has hinges that are left to lanes
    std::vector<std::uint8_t> ownGroups;       // by group: has joints of one's own
    std::vector<DirectGroup> direct;         // the first `directCount` of them are those
    std::size_t directCount = 0;
    std::vector<std::uint8_t> lostGroups;    // by group: did not find where it goes in this tick
    std::vector<std::uint8_t> thrownGroups;    // by group: by the passes of this tick
    std::vector<std::uint8_t> anewGroups;    // by group: whose passes begin once more, without loads
    std::vector<std::uint8_t> flatGroups;    // by group: asked for J v = 0 in this tick, from then on
    std::vector<std::uint8_t> outgrownGroups, tornGroups;  // by group, scratch
    std::vector<std::uint8_t> wholeGroups;   // by group: solved once a tick
    std::vector<std::uint8_t> touchedGroups;  // by group: by a contact, in this tick
    std::uint32_t fallbacks = 0;             // visits of the step in which a group was not solved at once
    ProjectionScratch projection;
    std::vector<BodyMotion<real>> velocities;   // scratch
    std::vector<BodyMotion<real>> before;    // by row, scratch
    std::vector<std::uint8_t> visited;             // by group, scratch
    std::vector<std::uint32_t> changed, changedBefore;  // by group, scratch: visits that changed a speed
    std::vector<real> fastest;               // by island, scratch  [m/s]
    std::vector<std::uint32_t> order;        // scratch
    std::vector<std::uint32_t> numbers;      // by row, scratch
    std::vector<std::size_t> members, bodies, placeOf;   // by group, scratch
    std::vector<std::uint8_t> hingesAt;      // by row, scratch: how many, up to 255
    std::vector<std::uint8_t> hit;           // by row: by an impact in this tick
    bool anyHit = false;
    std::vector<real> pull;                  // by row, scratch: sum of tension times arm   [N*m*s]
    std::vector<real> ownInvInertia;         // by row: of what joints tie, unguarded; else 0
    std::vector<std::uint32_t> guarded;  // rows with more moment of inertia in this tick than their own
    std::vector<MoreBodies> more;  // of the joints that have more than two
    std::uint32_t ownFaults = 0;  // of joints that have gone from the list in this step

    /// Times in the step that a constraint of one's own had no answer, or none that can be.
    std::uint32_t countFaults() const;

    bool empty() const { return ties.empty(); }
    std::uint32_t groupOfDirect(std::size_t place) const
    {
        return joints[direct[place].joints.front()].group;
    }
    bool isTied(std::size_t row) const { return groupOf[row] != kNone; }
    /// Has the body more moment of inertia in this tick than its own?
    bool isGuarded(std::uint32_t row, const Motion& motion) const
    {
        return isTied(row) && motion.invInertia != ownInvInertia[row];
    }
};

/// Masses so far apart that visits one by one do not settle what ties two bodies: one is so many times the
/// other.
inline constexpr double kUnevenTies = 30;

/// Can both be pushed, and is the mass of one more than `ratio` times that of the other?
bool areUneven(const Motion& a, const Motion& b, double ratio);

/// Which joints act, on what rows, and which bodies they tie together; measured at the present poses. Lists
/// that would be the same are kept.
void gatherJoints(JointTable& table, const BodyTable& bodies, const MotionTable& motions,
                  JointSystem& system);

/// The same again for bodies that have come into the step in its midst, with rows from `firstRow` on; the
/// loads that their joints carry are added to `steady`.
void bringInJoints(JointTable& table, const BodyTable& bodies, MotionTable& motions, JointSystem& system,
                   std::size_t firstRow);

/// The group at place `direct` is not solved at once for the rest of the step, but joint by joint, softly.
void soften(JointSystem& system, std::size_t direct);

/// After the passes: marks groups that soft rows hold, but not under what they bear in this tick. Not so for
/// what bodies bear that were hit.
void findTorn(JointSystem& system, const StepContext& context, std::vector<std::uint8_t>& groups);

/// Can a group be solved at once, and projected, that is not?
bool mayBeStiffened(const JointSystem& system, std::uint32_t group);

/// Is a group as large as those that may be solved at once?
bool hasStiffSize(const JointSystem& system, std::uint32_t group);

/// Is there a group that is, or can be?
bool mayProject(const JointSystem& system);

/// It is, for the rest of the step. False if its loops would fill its factors.
bool stiffen(JointSystem& system, const Table<Motion>& motions, std::uint32_t group);

/// Takes hinges away from the lanes, at the start of a step or of a tick: those of which a body `isOf` says
/// so, are visited one by one, once they have been measured.
template <class Test>
void takeFromLanes(JointSystem& system, Test isOf)
{
    const std::size_t taken = std::erase_if(system.hinges, [&](const JointTie& tie) {
        if (!isOf(tie)) return false;
        system.joints.emplace_back();
        static_cast<JointTie&>(system.joints.back()) = tie;
        return true;
    });
    if (taken == 0) return;
    ++system.listing;
    system.isAltered = true;
}

/// Errors, Jacobians and effective masses at the present poses, of the joints from `first` on.
void measureJoints(JointTable& table, const BodyTable& bodies, const MotionTable& motions,
                   JointSystem& system, std::size_t first = 0);

/// Light bodies between heavy loads turn under them faster than a tick can follow. They are given so much
/// moment of inertia for the tick that it can [eq. 11].
/// `system.pull` holds what lanes have added for theirs, by row. Returns whether any has another one now.
bool guardLightBodies(const JointTable& table, JointSystem& system, Table<Motion>& rows,
                      const StepContext& context);

/// After the passes: marks the groups solved at once in which loads came up that the tick was not begun for.
void findOutgrown(JointSystem& system, const Table<Motion>& rows, const StepContext& context,
                  std::vector<std::uint8_t>& groups);

/// After the last tick of a step: their own moments of inertia again.
void releaseGuard(JointSystem& system, Table<Motion>& rows);

/// Adds the velocity changes of the impulses that joints carry to Motion::steady, of joints that tie a row
/// from `firstRow` on; or of all to rows of it beside.
void addSteadyJoints(const JointTable& table, const JointSystem& system, Table<Motion>& rows,
                     std::size_t firstRow);
void addSteadyJoints(const JointTable& table, const JointSystem& system, const Table<Motion>& rows,
                     Table<LaneRow>& steady);

/// The same for the hinges that are left to lanes, from the table.
void addSteadyHinges(const JointTable& table, const BodyTable& bodies, const JointSystem& system,
                     Table<Motion>& rows, std::size_t firstRow);

/// Bodies tied to one that bears a load are loaded, too: all of a group is solved the same way. A load is
/// Motion::load, or the fourth number of a row.
void spreadLoad(JointSystem& system, Table<Motion>& rows);
void spreadLoad(JointSystem& system, Table<LaneRow>& steady);

/// Impulses as the tick begins, and what they aim at, for the velocities after the first kick.
void startJoints(const JointTable& table, const BodyTable& bodies, const MotionTable& motions,
                 const StepContext& context, JointSystem& system);

/// A joint of two bodies where these will be at the end of the tick.
JointRows jointAhead(const JointRow& joint, const BodyTable& bodies, const BodyPair& pair,
                     const StepContext& context);

/// What a joint aims at, for these velocities; returns by how much that changed.   [m/s]
/// `velocityOf` says the velocity of a row.
real aimPair(const JointTable& table, const BodyTable& bodies, const BodyPair& pair,
             const StepContext& context, JointRows& rows);
real aimOwn(const JointTable& table, const BodyTable& bodies, const BodySet& set, const StepContext& context,
            JointRows& rows);
template <class VelocityOf>
real aimJoint(const JointTable& table, const BodyTable& bodies, const MotionTable& motions,
              VelocityOf velocityOf, const StepContext& context, JointRows& rows)
{
    if (rows.own) return aimOwn(table, bodies, bodySetOf(rows, motions.rows, velocityOf), context, rows);
    const BodyPair pair{motions.rows[rows.rowA], motions.rows[rows.rowB], velocityOf(rows.rowA),
                        velocityOf(rows.rowB)};
    return aimPair(table, bodies, pair, context, rows);
}

/// After the drift, with the joints measured there: the velocity changes of the second half of what they
/// carry, along the directions that it has now, are added to `turned` of the bodies in halves.
void turnSteadyJoints(JointSystem& system, const Table<Motion>& rows, Table<LaneRow>& turned,
                      const StepContext& context);

/// After the visits before the drift, and after those that follow it: adds what the joints did in them to the
/// sums of the step.
void tallyJoints(JointTable& table, const JointSystem& system, const Table<Motion>& rows,
                 const Table<LaneRow>& velocities);

/// After the tick: what the joints carry on. A joint of a body that was hit carries what it did before: the
/// blow is not a load it will bear.
void keepJoints(JointTable& table, const JointSystem& system, const StepContext& context);

}  // namespace tamias2d::inline TAMIAS_PRECISION
