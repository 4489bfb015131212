// SPDX-License-Identifier: MIT
// Which piles are solved at once, and for how long they stay so.

#include "solver/stiff_piles.hpp"

#include <tamias2d/math/scalar.hpp>

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

constexpr std::uint32_t kMostBodies = 300;  // of a pile that is solved at once
constexpr double kUnevenTouches = 60;       // ratio of masses that may be too much for the passes
constexpr std::int8_t kPileSteps = 30;           // steps for which a pile stays so, or is not tried again
constexpr real kBears = 30;                 // times what forces do to the lighter one: a heavy load

// Does the contact bear a load that is heavy for one of its bodies?
bool bearsMuch(const Contact& c, const Motion& a, const Motion& b, real h)
{
    const real inverse = maximum(a.greatestInvMass(), b.greatestInvMass());
    const real forces = h * maximum(length(a.acceleration), length(b.acceleration));
    real load = 0;
    for (int k = 0; k < c.count; ++k) load += c.points[k].normalImpulse;
    return load > 0 && load * inverse > kBears * forces;
}

}  // namespace

void StiffPiles::begin(ContactTable& contacts, const MotionTable& motions, JointSystem& joints)
{
    count_ = 0;
    fallbacks_ = 0;
    candidates_.clear();
    mayCrush_ = false;
    pileOf_.clear();
    std::fill(joints.piledGroups.begin(), joints.piledGroups.end(), std::uint8_t{0});
    if (!mayBeUneven(motions)) return;
    connect(contacts, motions, joints);
    findCandidates(contacts, motions, joints);
    takeFromLanes(joints, [&](const JointTie& tie) {
        const std::uint32_t island = nearOf(tie.rowA, tie.rowB);
        return island != kNone && candidates_[island] != 0;
    });
    pileOfNear_.assign(near_.count(), kNone);
    for (const Contact& c : contacts.rows) {
        if (c.count == 0 || c.stiffSteps <= 0) continue;
        const std::uint32_t island = nearOf(c.rowA, c.rowB);
        if (island == kNone || candidates_[island] == 0 || pileOfNear_[island] != kNone) continue;
        pileOfNear_[island] = static_cast<std::uint32_t>(count_++);
    }
    if (count_ > 0) fill(0, contacts, joints);
}

bool StiffPiles::mayBeUneven(const MotionTable& motions) const
{
    const Motion *lightest = nullptr, *heaviest = nullptr;
    for (const Motion& m : motions.rows) {
        const real inverse = m.greatestInvMass();
        if (!(inverse > 0)) continue;
        if (lightest == nullptr || inverse > lightest->greatestInvMass()) lightest = &m;
        if (heaviest == nullptr || inverse < heaviest->greatestInvMass()) heaviest = &m;
    }
    return lightest != nullptr && areUneven(*lightest, *heaviest, kUnevenTies);
}

void StiffPiles::connect(const ContactTable& contacts, const MotionTable& motions, const JointSystem& joints)
{
    links_.clear();
    for (const Contact& c : contacts.rows)
        if (c.count > 0) links_.push_back({c.rowA, c.rowB});
    for (const JointTie& joint : joints.ties) {
        const std::uint32_t moving = joint.movingRow(motions.rows);
        joint.eachRow([&](std::uint32_t row) {
            if (row != moving) links_.push_back({moving, row});
        });
    }
    pushable_.assign(motions.rows.size(), false);
    for (std::size_t i = 0; i < motions.rows.size(); ++i) pushable_[i] = motions.rows[i].moves();
    linkIslands(links_, pushable_, [](std::uint32_t, std::uint32_t) { return true; }, near_);
}

void StiffPiles::findCandidates(const ContactTable& contacts, const MotionTable& motions,
                                const JointSystem& joints)
{
    const Table<Motion>& rows = motions.rows;
    touching_.assign(near_.count(), 0);
    refused_.assign(near_.count(), 0);
    candidates_.assign(near_.count(), 0);
    isLight_.assign(rows.size(), Lightness::None);
    const auto look = [&](std::uint32_t rowA, std::uint32_t rowB, Lightness as) {
        const double ratio = as == Lightness::Tied ? kUnevenTies : kUnevenTouches;
        if (!areUneven(rows[rowA], rows[rowB], ratio)) return;
        candidates_[nearOf(rowA, rowB)] = 1;
        const bool isA = rows[rowA].greatestInvMass() > rows[rowB].greatestInvMass();
        isLight_[isA ? rowA : rowB] = maximum(isLight_[isA ? rowA : rowB], as);
    };
    for (const JointTie& joint : joints.ties)
        joint.eachRow(
            [&](std::uint32_t a) { joint.eachRow([&](std::uint32_t b) { look(a, b, Lightness::Tied); }); });
    for (const Contact& c : contacts.rows) {
        if (c.count == 0) continue;
        const std::uint32_t island = nearOf(c.rowA, c.rowB);
        if (island == kNone) continue;
        touching_[island] = 1;
        look(c.rowA, c.rowB, Lightness::Touched);
        if (c.stiffSteps < 0) refused_[island] = 1;
    }
    for (std::uint32_t i = 0; i < near_.count(); ++i)
        if (near_.sizeOf[i] > kMostBodies || touching_[i] == 0 || refused_[i] != 0) candidates_[i] = 0;
    mayCrush_ = std::any_of(candidates_.begin(), candidates_.end(), [](std::uint8_t is) { return is != 0; });
}

std::uint32_t StiffPiles::nearOf(std::uint32_t rowA, std::uint32_t rowB) const
{
    if (maximum(rowA, rowB) >= near_.islandOf.size()) return kNone;
    const std::uint32_t island = near_.islandOf[rowA];
    return island != kNone ? island : near_.islandOf[rowB];
}

std::size_t StiffPiles::add(const std::vector<std::uint32_t>& closing, ContactTable& contacts,
                            JointSystem& joints)
{
    const std::size_t before = count_;
    for (const std::uint32_t i : closing) {
        const Contact& c = contacts.rows[i];
        const std::uint32_t island = nearOf(c.rowA, c.rowB);
        if (pileOfNear_[island] == kNone) pileOfNear_[island] = static_cast<std::uint32_t>(count_++);
    }
    if (count_ > before) fill(before, contacts, joints);
    return count_ - before;
}

// Contacts and joints of the piles from `first` on.
void StiffPiles::fill(std::size_t first, ContactTable& contacts, JointSystem& joints)
{
    if (piles_.size() < count_) piles_.resize(count_);
    for (std::size_t p = first; p < count_; ++p) {
        piles_[p].contacts.clear();
        piles_[p].group.joints.clear();
        piles_[p].restless = true;
        piles_[p].failed = false;
    }
    pileOf_.resize(contacts.rows.size(), kNone);
    const auto pileAt = [&](std::uint32_t rowA, std::uint32_t rowB) {
        const std::uint32_t island = nearOf(rowA, rowB);
        const std::uint32_t pile = island == kNone ? kNone : pileOfNear_[island];
        return pile != kNone && pile >= first ? pile : kNone;
    };
    for (std::uint32_t i = 0; i < contacts.rows.size(); ++i) {
        Contact& c = contacts.rows[i];
        const std::uint32_t pile = pileAt(c.rowA, c.rowB);
        if (pile == kNone) continue;
        c.stiffSteps = maximum(c.stiffSteps, std::int8_t{1});
        pileOf_[i] = pile;
        piles_[pile].contacts.push_back(i);
    }
    for (std::uint32_t j = 0; j < joints.joints.size(); ++j) {
        JointRows& joint = joints.joints[j];
        std::uint32_t pile = kNone;
        joint.eachRow([&](std::uint32_t row) { pile = pile == kNone ? pileAt(row, row) : pile; });
        if (pile == kNone) continue;
        piles_[pile].group.joints.push_back(j);
        joints.piledGroups[joint.group] = 1;
        joint.rigidly = true;
        joints.isAltered = true;
    }
}

void StiffPiles::end(ContactTable& contacts, const MotionTable& motions, const StepContext& context)
{
    if (candidates_.empty()) return;
    for (Contact& c : contacts.rows)
        if (c.stiffSteps < 0) ++c.stiffSteps;
    for (std::size_t p = 0; p < count_; ++p) {
        const std::vector<std::uint32_t>& members = piles_[p].contacts;
        const bool stays = std::any_of(members.begin(), members.end(), [&](std::uint32_t i) {
            const Contact& c = contacts.rows[i];
            return bearsMuch(c, motions.rows[c.rowA], motions.rows[c.rowB], context.h);
        });
        for (const std::uint32_t i : members) {
            std::int8_t& steps = contacts.rows[i].stiffSteps;
            if (piles_[p].failed)
                steps = -kPileSteps;
            else if (stays)
                steps = kPileSteps;
            else
                --steps;
        }
    }
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
