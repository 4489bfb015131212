// SPDX-License-Identifier: MIT
#pragma once

#include "solver/contact_lanes.hpp"
#include "solver/joint_passes.hpp"
#include "solver/settling.hpp"
#include "solver/stiff_piles.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// As a tick begins for a contact that is in no lane: arms, gaps and masses at the present poses, what is
/// loaded, and the velocity changes of what it carries, in rows.steady.
void startLoose(Contact& contact, const MotionTable& motions, TickRows& rows);

/// The contacts of a step as the passes go over them: plain ones in lanes, the others (of a tick with an
/// impact, elastic and unloaded, rolling, found in mid-step, beyond the colors) loose, one by one. The memory
/// is kept.
class ContactPasses {
public:
    explicit ContactPasses(Parallel& parallel) : parallel_(parallel) {}

    /// Before each step: the width of the lanes; not Best. Those of another one take nothing over.
    void use(LaneWidth width, ContactTable& contacts);

    /// Takes over the contacts of a step, colored and with manifolds; forgets the sums of the step before. If
    /// they are `same`, one by one, as at the end of the last step, those in lanes stay there; those that are
    /// `renewed` have been released.
    void begin(ContactTable& contacts, const MotionTable& motions, const Islands& islands,
               const TickRows& rows, const StepContext& context, bool same,
               const std::vector<std::uint8_t>& renewed);
    /// The ticks are over; what is `swept` leaves the lanes, to be looked at where it is now.
    void end(ContactTable& contacts, const std::vector<std::uint32_t>& swept);

    /// Then, for what is in lanes: where it is, what the next step asks of it, and whether it touches. Lists
    /// those of which that has changed. The rows of the table hear of all else when somebody asks: `tell`.
    ContactEndCounts conclude(const TickRows& rows, const StepContext& context, ContactTable& contacts,
                              std::vector<std::uint32_t>& changed);
    /// After the ticks: the rows of the table hear all that lanes know.
    void tell(ContactTable& contacts);
    /// The same, and nothing is in a lane any more: contacts are about to change their numbers.
    void leave(ContactTable& contacts);
    /// Manifolds of some contacts are about to change: likewise for them.
    void release(const std::vector<std::uint8_t>& which, ContactTable& contacts);

    /// A tick that stands for so many begins: only contacts of which both bodies are `quiet`, by row, take
    /// part, and carry that many times as much.
    void beginWhole(ContactTable& contacts, const std::vector<std::uint8_t>& quiet, int ticks);
    /// The passes of that tick, over rows.velocities: up to three, as long as one changes any speed.
    void solveWhole(ContactTable& contacts, MotionTable& motions, TickRows& rows, const StepContext& whole);
    /// It ends; only all others take part in what follows.
    void endWhole(ContactTable& contacts, int ticks);
    /// A contact that sits out takes part again, when all that it has done in so many ticks to come is yet to
    /// be done: it is loose then, and to be prepared. Returns whether it was one.
    bool comeIn(std::uint32_t contact, ContactTable& contacts, int ticks);

    /// Tells that the manifold of a contact is about to change: what is known of it is in the table then.
    void take(std::uint32_t contact, ContactTable& contacts);

    /// Where the contact stands in the order of solving. Those found in mid-step stand behind all others, in
    /// turn.
    std::uint32_t placeOf(std::uint32_t contact) const
    {
        return contact < placeOf_.size() ? placeOf_[contact] : contact;
    }

    /// Starts a tick: arms, gaps and masses at the present poses, and the velocity changes of what the
    /// contacts carry, in rows.steady; what carries a load now is loaded for the tick. They are taken with
    /// the arms of the present poses: carried over from the tick before, impulses at points that slide would
    /// change the angular momentum of the whole. Those of bodies that `joints` guard are loose: lanes know
    /// the own moments of inertia.
    void prepare(ContactTable& contacts, const MotionTable& motions, TickRows& rows,
                 const StepContext& context, const JointSystem* joints = nullptr);

    /// Contacts that an impact may end in this tick. No body has a point that is faster than `fastest` [m/s].
    const std::vector<std::uint32_t>& approaching(const TickRows& rows, const StepContext& context,
                                                  real fastest);
    /// Is the contact in a lane now, is it in a lane or loose? What is neither has no points.
    bool isInLane(std::uint32_t contact) const { return contact < inLane_.size() && inLane_[contact] != 0; }
    bool holds(std::uint32_t contact) const
    {
        return isInLane(contact) || (contact < isLoose_.size() && isLoose_[contact] != 0);
    }
    /// Looks at one that is in its lane.
    LaneView view(std::uint32_t contact) const { return lanes_->view(contact); }
    /// Before an impact acts on a contact or its manifold changes: prepared in the table, and loose for the
    /// tick.
    void loosen(std::uint32_t contact, ContactTable& contacts, const MotionTable& motions);

    /// All passes of a tick, over rows.velocities. One pass settles what rests. An island whose speeds it
    /// still changed gets further passes, up to a limit, on its own: its neighbors never notice [ADR19].
    /// Each pass goes over the joints first, if there are any.
    void solve(ContactTable& contacts, MotionTable& motions, TickRows& rows, const StepContext& context,
               const JointWorld* world = nullptr, JointSystem* joints = nullptr)
    {
        const real restless = context.tuning.restless * context.lengthUnit;
        solve(contacts, motions, rows, context,
              {context.tuning.extraPasses, context.tuning.settlingPasses, restless, false}, world, joints);
    }
    /// After them: what they leave restless is solved at once, if that may be.
    void finish(ContactTable& contacts, const MotionTable& motions, TickRows& rows,
                const JointWorld* world = nullptr, JointSystem* joints = nullptr);
    /// Further passes, over the `islands` alone, of which contacts or joints ask for something else now.
    void solveAgain(ContactTable& contacts, MotionTable& motions, TickRows& rows,
                    const std::vector<std::uint8_t>& islands, const JointWorld& world, JointSystem& joints);
    /// A contact is about to be changed between passes: it is loose from here on.
    void takeOut(std::uint32_t contact, ContactTable& contacts, const MotionTable& motions);
    /// When all have been made: adds what contacts did to the sums of the step.
    void addUp(ContactTable& contacts, const MotionTable& motions, const StepContext& context);
    /// Then: contacts of which a point carries something that carried nothing as the tick began, in solving
    /// order.
    const std::vector<std::uint32_t>& newlyLoaded(const ContactTable& contacts);
    /// Finds the piles anew: at the start of a step, and when others come into it.
    void pile(ContactTable& contacts, const MotionTable& motions, JointSystem& joints)
    {
        piles_.begin(contacts, motions, joints);
    }
    void endPiles(ContactTable& contacts, const MotionTable& motions, const StepContext& context)
    {
        piles_.end(contacts, motions, context);
    }
    const StiffPiles& piles() const { return piles_; }
    /// Before passes that may have to be taken back: keeps the impulses. `restore` gives them back.
    void keep(const ContactTable& contacts);
    void restore(ContactTable& contacts);
    /// Displacements that undo overlaps, in rows.pushes. They leave velocities alone, but for repayPush.
    void pushApart(ContactTable& contacts, MotionTable& motions, TickRows& rows, const StepContext& context,
                   ClampCounts& clamps, const JointWorld* world = nullptr,
                   const JointSystem* joints = nullptr);

private:
    static constexpr std::uint8_t kSitsOut = 3;  // of isLoose_

    Parallel& parallel_;
    std::unique_ptr<ContactLanes> lanes_;
    LaneWidth width_ = LaneWidth::Best;  // of those; Best: there are none yet
    const Islands* islands_ = nullptr;  // of the step
    std::vector<std::uint32_t> loose_;  // contacts out of their lanes that have points, in solving order
    std::vector<std::uint8_t> isLoose_;  // by contact: is it in that list, or would be, but sits out?
    bool anySitsOut_ = false;
    bool isTold_ = true;  // is there nothing in the lanes that the table does not know?
    bool areLeft_ = true;  // is nothing in them?
    std::vector<std::uint32_t> outLoose_;  // those that sit out a tick that stands for many
    std::vector<std::uint8_t> inLane_;  // by contact: is it in its lane?
    std::vector<std::uint32_t> placeOf_;  // by contact: in the order of solving
    std::vector<std::uint32_t> looseEnds_;  // by color of the lanes
    std::vector<std::uint32_t> colorEnds_;  // of those, in places
    std::vector<std::uint32_t> list_;
    std::vector<std::uint8_t> unrest_, visited_;  // by island: after its last pass; in the next one
    std::vector<std::uint32_t> changes_;  // by island: contacts of which the last pass changed a speed
    SettlingIslands settling_;
    Table<Contact> kept_;  // the loose ones, in their order
    StiffPiles piles_;

    // How many more passes than one, over islands of which a pass changed a speed by more [m/s]: one along a
    // normal, or any. How many over those that have nearly come to rest.
    struct Unrest {
        int extraPasses, settlingPasses;
        real restless;
        bool ofAny;
        const std::uint8_t* islands = nullptr;  // of the first pass; null: all
    };
    void solve(ContactTable& contacts, MotionTable& motions, TickRows& rows, const StepContext& context,
               const Unrest& limit, const JointWorld* world, JointSystem* joints);
    void findCrushing(const ContactTable& contacts, const MotionTable& motions, const TickRows& rows,
                      const StepContext& context);
    real closing(std::uint32_t contact, const Contact& c, const MotionTable& motions, const TickRows& rows,
                 const StepContext& context) const;
    bool leaveLane(std::uint32_t contact, Contact& c);
    void addLoose(std::uint32_t contact);
    void fillLanes(ContactTable& contacts, const MotionTable& motions, const TickRows& rows);
    void sortLoose();
    bool chooseSettling(int passes, const MotionTable& motions, const TickRows& rows,
                        const StepContext& context, const Unrest& limit);
    template <class OfColor, class OfLoose>
    void visitColors(OfColor ofColor, OfLoose ofLoose);
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
