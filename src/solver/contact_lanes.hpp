// SPDX-License-Identifier: MIT
#pragma once

#include "islands/links.hpp"
#include "model/contacts.hpp"
#include "model/motion.hpp"
#include "model/step_context.hpp"
#include "solver/contact_kernels.hpp"
#include "solver/tick_rows.hpp"
#include "tasks/parallel.hpp"

#include <tamias2d/base/lane_width.hpp>
#include <tamias2d/model/clamps.hpp>

#include <cstdint>
#include <memory>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What a lane says of its contact in a tick that has begun.
struct LaneView {
    Vec2 normal;
    bool isLoaded = false;
    struct Point {
        real turnA, turnB;   ///< arm x normal   [m]
        real gap;            ///< beyond the rest gap   [m]
        bool yields;         ///< does an impulse at it move anything?
        bool wasLoaded;      ///< did it carry anything as the tick began?
        real normalImpulse, tangentImpulse;   ///< [N*s]
    } points[2];
};

/// The plain contacts of a step, several side by side: no two contacts of one block share a body that moves.
/// While a contact is in a lane, its impulses and sums are there and those of the ContactTable are of before.
///
/// One object for each width; all give the same bits, those of visiting the contacts of a color one by one by
/// the functions of contacts/rows.hpp [ADR5, ADR6], but that these round the distance between the centers of
/// the bodies once and lanes the way of each since its reference pose.
class ContactLanes {
public:
    virtual ~ContactLanes() = default;

    /// Gives each contact that may be plain in this step a lane.
    virtual void build(const ContactTable& contacts, const MotionTable& motions, const Islands& islands,
                       const StepContext& context) = 0;
    /// Is each contact still of the kind that it was when the lanes were built, but for a few with a point
    /// more or less? Only those that are `renewed` may have changed. Then what is in a lane may stay there
    /// for another step.
    virtual bool fits(const Table<Contact>& contacts, const std::vector<std::uint8_t>& renewed,
                      const StepContext& context) const = 0;
    /// Starts another step with what is in the lanes: sums begin at nothing, islands may be others.
    virtual void carryOn(const Islands& islands, const TickRows& rows) = 0;
    virtual bool hasLane(std::uint32_t contact) const = 0;
    /// Takes the contact into its lane.
    virtual void load(std::uint32_t contact, const Contact& row, const MotionTable& motions,
                      const TickRows& rows) = 0;
    /// Takes all contacts that have a lane and this mark into it.
    virtual void loadMarked(const std::vector<std::uint8_t>& marks, std::uint8_t mark,
                            const Table<Contact>& contacts, const MotionTable& motions,
                            const TickRows& rows) = 0;
    /// Looks at a contact that is in its lane.
    virtual LaneView view(std::uint32_t contact) const = 0;
    /// What the contact does in this tick is not added to its sums by its lane: somebody else will.
    virtual void leaveSums(std::uint32_t contact) = 0;
    /// Gives impulses and sums back, and takes the contact out of its lane.
    virtual void unload(std::uint32_t contact, Contact& row) = 0;
    /// Takes the contact out of its lane; what the table has of it is newer.
    virtual void drop(std::uint32_t contact) = 0;
    /// A tick that stands for so many begins: only contacts of which both bodies are `quiet`, by row, take
    /// part, with impulses that are so many times as great; the rest sit it out, in their lanes.
    virtual void beginWhole(const std::vector<std::uint8_t>& quiet, real ticks) = 0;
    /// It ends: all that was done is added to the sums, impulses are those of one tick again. Those that have
    /// taken part sit out what follows, and the rest do not.
    virtual void endWhole(real ticks) = 0;
    virtual bool sitsOut(std::uint32_t contact) const = 0;
    /// It takes part again; all do.
    virtual void comeIn(std::uint32_t contact) = 0;
    virtual void comeIn() = 0;
    /// The end of a step: arms and gaps at the poses of `rows`, all that was done added to the sums, and what
    /// a step asks of contacts told to the table beside its rows. Lists those that touch and did not at the
    /// end of the step before, or the reverse.
    virtual ContactEndCounts conclude(const TickRows& rows, const StepContext& context,
                                      ContactTable& contacts, std::vector<std::uint32_t>& changed) = 0;
    /// After it: gives all that is known of one, or of all, to the rows of the table; they stay in their
    /// lanes.
    virtual void tell(std::uint32_t contact, Contact& row) const = 0;
    virtual void tellAll(Table<Contact>& rows) const = 0;

    /// Arms, gaps and masses at the poses of `rows`; adds the velocity changes of what the contacts carry to
    /// rows.steady. Elastic contacts that carry nothing are no longer plain: they are listed.
    virtual void prepare(TickRows& rows, const StepContext& context, std::vector<std::uint32_t>& open) = 0;
    /// Lists the contacts that an impact may end in this tick; none that may is left out. No body has a point
    /// that is faster than `fastest` [m/s].
    virtual void findApproaching(const TickRows& rows, const StepContext& context, real fastest,
                                 std::vector<std::uint32_t>& found) const = 0;
    /// Lists the contacts of which a point carries something that carried nothing as the tick began.
    virtual void findNewlyLoaded(std::vector<std::uint32_t>& found) const = 0;
    virtual int colors() const = 0;
    /// One pass over a color in the islands that are `visited`, or in all if that is null; notes in `unrest`
    /// where it changed a speed by more than `restless` [m/s]: one along a normal, or `ofAny`.
    virtual void pass(int color, TickRows& rows, const std::uint8_t* visited, const UnrestNotes& unrest,
                      real restless, bool ofAny) = 0;
    /// Keeps all impulses, and gives them back as they were kept.
    virtual void keep() = 0;
    virtual void restore() = 0;
    /// The pass that undoes overlaps, and what that costs the velocities.
    virtual void push(int color, TickRows& rows, const StepContext& context, ClampCounts& clamps) = 0;
    virtual void repay(int color, TickRows& rows, const StepContext& context) = 0;
};

/// May the contact be in a lane in this tick? Not if the tick has an impact of it, nothing of it is left to
/// impacts, and rolling resistance does not make it a case of its own.
bool isPlain(const Contact& contact);

/// The island of either body.
inline std::uint32_t islandOf(const Islands& islands, std::uint32_t rowA, std::uint32_t rowB)
{
    const std::uint32_t island = islands.islandOf[rowA];
    return island != Islands::kNone ? island : islands.islandOf[rowB];
}

/// For the width, which the machine must have.
std::unique_ptr<ContactLanes> makeContactLanes(LaneWidth width, Parallel& parallel);

}  // namespace tamias2d::inline TAMIAS_PRECISION
