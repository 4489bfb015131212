// SPDX-License-Identifier: MIT
// Heavy bodies on light ones: what the passes cannot settle is solved at once. docs/theory/joints.md,
// section 8.
#pragma once

#include "islands/links.hpp"
#include "joints/tick.hpp"
#include "model/contacts.hpp"
#include "solver/joint_passes.hpp"
#include "solver/tick_rows.hpp"

#include <tamias2d/model/clamps.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Bodies that contacts and joints tie together, whose rows are all solved at once.
struct StiffPile {
    DirectGroup group;
    std::vector<std::uint32_t> contacts;  // in the ContactTable
    std::vector<std::array<real, 2>> carried;  // by contact: normal impulses as the tick began   [N*s]
    std::vector<std::uint8_t> places;     // by row of a contact, in turn: which of its impulses that is
    DirectGroup push;                     // the same to undo overlaps
    bool restless = false;                // did the last pass change a speed?
    bool failed = false;  // no solution was found in this step: its rows are visited singly
};

/// The piles of a step. A **pile** is what contacts with points and joints connect. It may be solved at once
/// if masses in it that touch, or are tied, are far apart, and it has not too many bodies; it is, if the
/// passes of a tick leave it restless, and stays so as long as it bears a heavy load and for some
/// steps after that.
class StiffPiles {
public:
    /// Finds the piles that may be solved at once, and those that are to be from the start.
    void begin(ContactTable& contacts, const MotionTable& motions, JointSystem& joints);
    bool empty() const { return count_ == 0; }
    std::size_t count() const { return count_; }
    /// Is the contact one of a pile that is solved at once?
    bool holds(std::uint32_t contact) const
    {
        return contact < pileOf_.size() && pileOf_[contact] != kNone && !piles_[pileOf_[contact]].failed;
    }

    /// Does the contact press a light body that a heavy one touches, or is tied to, where they may be solved
    /// at once?
    enum class Lightness : std::uint8_t { None, Touched, Tied };
    Lightness crushes(const Contact& contact) const
    {
        if (candidates_.empty() || maximum(contact.rowA, contact.rowB) >= isLight_.size())
            return Lightness::None;
        const std::uint32_t island = nearOf(contact.rowA, contact.rowB);
        if (island == kNone || candidates_[island] == 0 || pileOfNear_[island] != kNone)
            return Lightness::None;
        return maximum(isLight_[contact.rowA], isLight_[contact.rowB]);
    }
    bool mayCrush() const { return mayCrush_; }
    /// Makes those of these contacts, which crush, piles to solve at once; returns how many.
    std::size_t add(const std::vector<std::uint32_t>& closing, ContactTable& contacts, JointSystem& joints);
    const StiffPile& operator[](std::size_t p) const { return piles_[p]; }

    /// One pass over the piles from `first` on: over all that is new to the tick, or restless. Returns
    /// whether one still is.
    bool pass(std::size_t first, bool anew, ContactTable& contacts, const JointWorld& world,
              JointSystem& joints, Table<LaneRow>& velocities, std::vector<std::uint8_t>& unrest);

    /// At the end of a tick: what a contact has borne for the first time may be a blow, and is carried on
    /// only in part.
    void forgetBlows(ContactTable& contacts, const MotionTable& motions, const StepContext& context);

    /// Displacements that undo overlaps, of all that is solved at once.
    void pushApart(ContactTable& contacts, const JointWorld& world, const JointSystem& joints,
                   Table<LaneRow>& pushes, ClampCounts& clamps);

    /// At the end of a step: which stay so.
    void end(ContactTable& contacts, const MotionTable& motions, const StepContext& context);

    std::uint32_t fallbacks() const { return fallbacks_; }

private:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    Islands near_;  // what contacts with points and joints connect
    std::vector<Link> links_;
    std::vector<bool> pushable_;
    std::vector<std::uint8_t> candidates_;  // by those
    bool mayCrush_ = false;  // is any?
    std::vector<std::uint8_t> touching_, refused_;  // likewise: has it contacts, is it not to be tried
    std::vector<std::uint32_t> pileOfNear_;  // likewise; kNone
    std::vector<Lightness> isLight_;  // by row: is it the light one of two that are uneven?
    std::vector<std::uint32_t> pileOf_;  // by contact; kNone
    std::vector<StiffPile> piles_;  // the first `count_` of them; keep their memory
    std::size_t count_ = 0;
    std::uint32_t fallbacks_ = 0;
    std::vector<BodyMotion<real>> own_, before_;  // by node, scratch
    std::vector<JointRows> kept_;  // of the pile at hand, scratch

    std::uint32_t nearOf(std::uint32_t rowA, std::uint32_t rowB) const;
    bool mayBeUneven(const MotionTable& motions) const;
    void connect(const ContactTable& contacts, const MotionTable& motions, const JointSystem& joints);
    void findCandidates(const ContactTable& contacts, const MotionTable& motions, const JointSystem& joints);
    void fill(std::size_t first, ContactTable& contacts, JointSystem& joints);
    void start(StiffPile& pile, const ContactTable& contacts, const JointWorld& world, JointSystem& joints,
               Table<LaneRow>& velocities);
    bool isThrown(const StiffPile& pile, const std::vector<BodyMotion<real>>& before, const JointWorld& world,
                  const JointSystem& joints) const;
    real disband(StiffPile& pile, ContactTable& contacts, const JointWorld& world, JointSystem& joints,
                 Table<LaneRow>& velocities);
    real visit(StiffPile& pile, ContactTable& contacts, const JointWorld& world, JointSystem& joints,
               Table<LaneRow>& velocities);
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
