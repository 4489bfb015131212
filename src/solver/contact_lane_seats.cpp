// SPDX-License-Identifier: MIT
// Which contact gets which lane, and for how long.

#include "contacts/rows.hpp"
#include "math/with_lanes.hpp"
#include "solver/contact_lane_loops.hpp"
#include "solver/contact_lane_rows.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

template <int W>
void ContactLanesOf<W>::build(const ContactTable& contacts, const MotionTable& motions,
                              const Islands& islands, const StepContext& context)
{
    context_ = context;
    solved_ = false;
    sortByKind(contacts);
    laneOf_.resize(contacts.rows.size());
    std::fill(laneOf_.begin(), laneOf_.end(), kNone);
    blocks_.reserve(slots_.capacity() / W);
    sources_.reserve(blocks_.capacity());
    blocks_.resize(slots_.size() / W);
    sources_.resize(blocks_.size());
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
            blocks_[k] = {};
            sources_[k] = {};
            for (std::size_t slot = k * W; slot < (k + 1) * W; ++slot)
                if (slots_[slot] != kNone)
                    place(slots_[slot], contacts.rows[slots_[slot]], slot, motions, islands);
                else
                    leaveEmpty(slot);
        }
    });
}

template <int W>
void ContactLanesOf<W>::place(std::uint32_t contact, const Contact& row, std::size_t slot,
                              const MotionTable& motions, const Islands& islands)
{
    Block& b = blocks_[slot / W];
    const auto lane = static_cast<int>(slot % W);
    const std::uint32_t bit = 1u << lane;
    laneOf_[contact] = static_cast<std::uint32_t>(slot);
    sources_[slot / W].contact[lane] = contact;
    b.rowA[lane] = row.rowA;
    b.rowB[lane] = row.rowB;
    b.island[lane] = islandOf(islands, row.rowA, row.rowB);
    b.oneIsland = b.oneIsland && b.island[lane] == b.island[0];
    if (motions.rows[row.rowA].moves()) b.movesA |= bit;
    if (motions.rows[row.rowB].moves()) b.movesB |= bit;
}

// It reads what its neighbor reads, and no row that another thread may be writing.
template <int W>
void ContactLanesOf<W>::leaveEmpty(std::size_t slot)
{
    Block& b = blocks_[slot / W];
    b.rowA[slot % W] = b.rowA[0];
    b.rowB[slot % W] = b.rowB[0];
}

template <int W>
std::uint8_t ContactLanesOf<W>::kindOf(const Contact& c)
{
    const bool hasLane = !(c.rolling > 0) && (c.count > 0 || c.swept);
    return hasLane ? static_cast<std::uint8_t>(2 - c.count) : kNoLane;
}

template <int W>
bool ContactLanesOf<W>::fits(const Table<Contact>& contacts, const std::vector<std::uint8_t>& renewed,
                             const StepContext& context) const
{
    const bool isSame = context.h == context_.h && context.tuning == context_.tuning &&
                        context.lengthUnit == context_.lengthUnit && kinds_.size() == contacts.size();
    if (!isSame) return false;
    std::size_t misplaced = 0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (renewed[i] == 0) continue;
        const std::uint8_t kind = kindOf(contacts[i]);
        if ((kind == kNoLane) != (kinds_[i] == kNoLane)) return false;
        misplaced += kind == kinds_[i] ? 0 : 1;
    }
    return misplaced * kFewOf <= contacts.size();
}

template <int W>
void ContactLanesOf<W>::carryOn(const Islands& islands, const TickRows& rows)
{
    solved_ = false;
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        for (std::size_t k = chunk.begin; k < chunk.end; ++k) {
            Block& b = blocks_[k];
            Source& s = sources_[k];
            s.counted = maskOf<W>(0);
            s.stepImpulse = {};
            s.stepNormal[0] = s.stepNormal[1] = s.stepTangent[0] = s.stepTangent[1] = {};
            b.oneIsland = true;
            for (int lane = 0; lane < W; ++lane) {
                if (slots_[k * W + static_cast<std::size_t>(lane)] == kNone) continue;
                const std::uint32_t rowA = b.rowA[lane], rowB = b.rowB[lane];
                b.island[lane] = islandOf(islands, rowA, rowB);
                b.oneIsland = b.oneIsland && b.island[lane] == b.island[0];
                setLane(s.start, lane, startBetween(rows, rowA, rowB));
            }
        }
    });
}

// Who gets which lane. Two points first, so that blocks of one point need not look for a second.
template <int W>
void ContactLanesOf<W>::sortByKind(const ContactTable& contacts)
{
    constexpr std::size_t kContacts = 512;
    kinds_.resize(contacts.rows.size());
    parallel_.forEach(contacts.rows.size(), kContacts, [&](const Chunk& chunk) {
        for (std::size_t i = chunk.begin; i < chunk.end; ++i) kinds_[i] = kindOf(contacts.rows[i]);
    });

    slots_.clear();
    slots_.reserve(contacts.rows.capacity() + 2 * W * (colorEnds_.size() + 1));
    colorEnds_.clear();
    std::size_t at = 0;
    // The last color is visited in order, and what is found in mid-step has no lane either.
    for (std::size_t color = 0; color + 1 < contacts.colorEnds.size(); ++color) {
        for (auto& list : sorted_) list.clear();
        for (; at < contacts.colorEnds[color]; ++at) {
            const std::uint32_t i = contacts.order[at];
            if (kinds_[i] != kNoLane) sorted_[kinds_[i]].push_back(i);
        }
        const std::size_t count = sorted_[0].size() + sorted_[1].size() + sorted_[2].size();
        if (count == 0 && at == contacts.order.size()) break;
        for (const auto& list : sorted_) slots_.insert(slots_.end(), list.begin(), list.end());
        slots_.resize((slots_.size() + W - 1) / W * W, std::uint32_t{kNone});
        colorEnds_.push_back(slots_.size() / W);
    }
}

}  // namespace

bool isPlain(const Contact& c)
{
    if (c.count == 0 || c.impacts > 0 || c.rolling > 0 || c.rollingImpulse != 0) return false;
    if (!(c.restitution > 0)) return true;
    for (int i = 0; i < c.count; ++i)
        if (!(c.points[i].normalImpulse > 0)) return false;
    return true;
}

std::unique_ptr<ContactLanes> makeContactLanes(LaneWidth width, Parallel& parallel)
{
    return withLanes(width, [&](auto lanes) -> std::unique_ptr<ContactLanes> {
        return std::make_unique<ContactLanesOf<lanes()>>(parallel);
    });
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
