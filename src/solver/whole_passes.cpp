// SPDX-License-Identifier: MIT
// Contacts in a tick that stands for many, and those that sit out: docs/theory/calm.md, section 6.

#include "contacts/rows.hpp"
#include "solver/contact_passes.hpp"

#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// A long tick has fewer passes than many short ones: with one alone, small pyramids quiver twice as often. An
// island is done with a pass that changes no speed by more than a hundred roundings of Tuning::restless.
constexpr int kPasses = 3;
constexpr real kDone = 100 * std::numeric_limits<real>::epsilon();

void scale(Contact& c, real factor)
{
    for (ContactPointRow& point : c.points) {
        point.normalImpulse *= factor;
        point.tangentImpulse *= factor;
    }
    c.rollingImpulse *= factor;
}

}  // namespace

void ContactPasses::beginWhole(ContactTable& contacts, const std::vector<std::uint8_t>& quiet, int ticks)
{
    anySitsOut_ = true;
    lanes_->beginWhole(quiet, static_cast<real>(ticks));
    outLoose_.clear();
    std::erase_if(loose_, [&](std::uint32_t i) {
        Contact& c = contacts.rows[i];
        const bool takesPart = (quiet[c.rowA] & quiet[c.rowB]) != 0;
        if (takesPart)
            scale(c, static_cast<real>(ticks));
        else
            outLoose_.push_back(i);
        return !takesPart;
    });
}

void ContactPasses::solveWhole(ContactTable& contacts, MotionTable& motions, TickRows& rows,
                               const StepContext& whole)
{
    const real restless = whole.tuning.restless * whole.lengthUnit;
    solve(contacts, motions, rows, whole, {kPasses - 1, 0, kDone * restless, true}, nullptr, nullptr);
}

void ContactPasses::endWhole(ContactTable& contacts, int ticks)
{
    lanes_->endWhole(static_cast<real>(ticks));
    for (const std::uint32_t i : loose_) {
        scale(contacts.rows[i], 1 / static_cast<real>(ticks));
        isLoose_[i] = kSitsOut;
    }
    loose_.swap(outLoose_);
}

bool ContactPasses::comeIn(std::uint32_t contact, ContactTable& contacts, int ticks)
{
    Contact& c = contacts.rows[contact];
    if (isInLane(contact)) {
        if (!lanes_->sitsOut(contact)) return false;
        lanes_->comeIn(contact);
        leaveLane(contact, c);
    } else {
        if (contact >= isLoose_.size() || isLoose_[contact] != kSitsOut) return false;
        isLoose_[contact] = 0;
    }
    addToSums(c, -ticks);
    addLoose(contact);
    return true;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
