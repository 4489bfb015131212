// SPDX-License-Identifier: MIT
// Which contact is in which lane, and the way in and out; the reckoning is that of contact_kernels.hpp.

#include "solver/contact_lanes.hpp"

#include "contacts/rows.hpp"
#include "math/with_lanes.hpp"
#include "solver/contact_kernels.hpp"
#include "solver/flight.hpp"

#include <algorithm>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

template <int W>
class ContactLanesOf final : public ContactLanes {
public:
    explicit ContactLanesOf(Parallel& parallel) : parallel_(parallel) {}

    void build(const ContactTable& contacts, const MotionTable& motions, const Islands& islands,
               const StepContext& context) override;
    bool fits(const Table<Contact>& contacts, const std::vector<std::uint8_t>& renewed,
              const StepContext& context) const override;
    void carryOn(const Islands& islands, const TickRows& rows) override;
    bool hasLane(std::uint32_t contact) const override
    {
        return contact < laneOf_.size() && laneOf_[contact] != kNone;
    }
    void load(std::uint32_t contact, const Contact& row, const MotionTable& motions,
              const TickRows& rows) override;
    LaneView view(std::uint32_t contact) const override;
    void leaveSums(std::uint32_t contact) override
    {
        sources_[laneOf_[contact] / W].counted.v[laneOf_[contact] % W] = 0;
    }
    void unload(std::uint32_t contact, Contact& row) override;
    void drop(std::uint32_t contact) override;
    void beginWhole(const std::vector<std::uint8_t>& quiet, real ticks) override;
    void endWhole(real ticks) override;
    bool sitsOut(std::uint32_t contact) const override
    {
        return (blocks_[laneOf_[contact] / W].out >> laneOf_[contact] % W & 1u) != 0;
    }
    void comeIn(std::uint32_t contact) override
    {
        Block& b = blocks_[laneOf_[contact] / W];
        const std::uint32_t bit = 1u << laneOf_[contact] % W;
        b.out &= ~bit;
        b.active |= bit;
    }
    void comeIn() override;
    void storeAll(Table<Contact>& rows) const override;

    void loadMarked(const std::vector<std::uint8_t>& marks, std::uint8_t mark, const Table<Contact>& contacts,
                    const MotionTable& motions, const TickRows& rows) override;

    void prepare(TickRows& rows, const StepContext& context, std::vector<std::uint32_t>& open) override;
    void findApproaching(const TickRows& rows, const StepContext& context, real fastest,
                         std::vector<std::uint32_t>& found) const override;
    void findNewlyLoaded(std::vector<std::uint32_t>& found) const override;
    void keep() override { kept_ = blocks_; }
    void restore() override { blocks_ = kept_; }
    int colors() const override { return static_cast<int>(colorEnds_.size()); }
    void pass(int color, TickRows& rows, const std::uint8_t* visited, std::uint8_t* unrest,
              real restless) override
    {
        solved_ = true;
        eachChunk(color, [&](std::size_t first, std::size_t count, std::size_t) {
            Kernels::pass(blocks_.data() + first, count, rows, visited, unrest, restless);
        });
    }
    void push(int color, TickRows& rows, const StepContext& context, ClampCounts& clamps) override
    {
        counts_.assign(Parallel::chunksOf(countOf(color), kGrain), 0);
        eachChunk(color, [&](std::size_t first, std::size_t count, std::size_t chunk) {
            counts_[chunk] =
                Kernels::push(blocks_.data() + first, sources_.data() + first, count, rows, context);
        });
        for (const std::size_t held : counts_) clamps.push += static_cast<std::uint32_t>(held);
    }
    void repay(int color, TickRows& rows, const StepContext& context) override
    {
        eachChunk(color, [&](std::size_t first, std::size_t count, std::size_t) {
            Kernels::repay(blocks_.data() + first, sources_.data() + first, count, rows, context);
        });
    }

private:
    using Kernels = ContactKernels<W>;
    using Block = ContactBlock<W>;
    using Source = ContactSource<W>;
    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr std::uint8_t kNoLane = 3;   // a kind
    static constexpr std::size_t kGrain = 256 / W;   // blocks that are worth a thread's while
    static constexpr std::size_t kFewOf = 32;   // contacts: one among them may be where another kind is

    Parallel& parallel_;
    StepContext context_;
    std::vector<std::uint32_t> laneOf_;      // by contact: block times W, plus lane
    Table<Block> blocks_;              // color by color
    Table<Block> kept_;
    Table<Source> sources_;
    std::vector<std::size_t> colorEnds_;     // in blocks
    std::vector<std::uint8_t> kinds_;        // by contact: which of these lists it belongs to
    std::vector<std::uint32_t> sorted_[3];   // contacts of a color: of two points, of one, of none yet
    std::vector<std::uint32_t> slots_;       // contacts by lane; kNone for an empty one
    mutable std::vector<std::uint32_t> room_;   // a place for every lane
    mutable std::vector<std::size_t> counts_;   // by chunk
    bool solved_ = false;                    // have the passes of the tick begun?

    std::size_t firstOf(int color) const
    {
        return color == 0 ? 0 : colorEnds_[static_cast<std::size_t>(color) - 1];
    }
    std::size_t countOf(int color) const
    {
        return colorEnds_[static_cast<std::size_t>(color)] - firstOf(color);
    }
    // Calls body(first block, blocks, number of the chunk) for each chunk of a color.
    template <class Body>
    void eachChunk(int color, Body body)
    {
        const std::size_t start = firstOf(color);
        parallel_.forEach(countOf(color), kGrain, [&](const Chunk& chunk) {
            body(start + chunk.begin, chunk.end - chunk.begin, chunk.index);
        });
    }
    static std::uint8_t kindOf(const Contact& c);
    void sortByKind(const ContactTable& contacts);
    void store(std::size_t slot, Contact& row) const;
    void leaveEmpty(std::size_t slot);
    std::size_t closeUp(std::uint32_t* list, std::size_t first, std::size_t end) const;
    template <class Find>
    void listAll(Find find, std::vector<std::uint32_t>& found) const;
    void place(std::uint32_t contact, const Contact& row, std::size_t slot, const MotionTable& motions,
               const Islands& islands);
};

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

// The chunks of the blocks from `first` on have listed counts_ contacts, each chunk where its lanes begin:
// they move up behind the `end` that are there. Returns how many that makes.
template <int W>
std::size_t ContactLanesOf<W>::closeUp(std::uint32_t* list, std::size_t first, std::size_t end) const
{
    for (std::size_t chunk = 0; chunk < counts_.size(); ++chunk) {
        const std::uint32_t* const from = list + W * (first + chunk * kGrain);
        end = static_cast<std::size_t>(std::copy(from, from + counts_[chunk], list + end) - list);
    }
    return end;
}

template <int W>
void ContactLanesOf<W>::prepare(TickRows& rows, const StepContext& context, std::vector<std::uint32_t>& open)
{
    solved_ = false;
    const std::size_t before = open.size();
    std::size_t end = 0;
    open.reserve(before + slots_.capacity());
    open.resize(before + W * blocks_.size());
    for (int color = 0; color < colors(); ++color) {
        counts_.assign(Parallel::chunksOf(countOf(color), kGrain), 0);
        std::uint32_t* const room = open.data() + before;
        eachChunk(color, [&](std::size_t first, std::size_t count, std::size_t chunk) {
            counts_[chunk] = Kernels::prepare(blocks_.data() + first, sources_.data() + first, count, rows,
                                              context, room + W * first);
        });
        end = closeUp(room, firstOf(color), end);
    }
    open.resize(before + end);
}

// What find(first block, blocks, list) lists of each chunk of all blocks, in their order.
template <int W>
template <class Find>
void ContactLanesOf<W>::listAll(Find find, std::vector<std::uint32_t>& found) const
{
    if (room_.size() < W * blocks_.size()) room_.resize(blocks_.capacity() * W);
    counts_.assign(Parallel::chunksOf(blocks_.size(), kGrain), 0);
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        counts_[chunk.index] = find(chunk.begin, chunk.end - chunk.begin, room_.data() + W * chunk.begin);
    });
    found.assign(room_.data(), room_.data() + closeUp(room_.data(), 0, 0));
}

template <int W>
void ContactLanesOf<W>::findApproaching(const TickRows& rows, const StepContext& context, real fastest,
                                        std::vector<std::uint32_t>& found) const
{
    listAll(
        [&](std::size_t first, std::size_t count, std::uint32_t* list) {
            return Kernels::findApproaching(blocks_.data() + first, sources_.data() + first, count, rows,
                                            context, fastest, list);
        },
        found);
}

template <int W>
void ContactLanesOf<W>::findNewlyLoaded(std::vector<std::uint32_t>& found) const
{
    listAll(
        [&](std::size_t first, std::size_t count, std::uint32_t* list) {
            return Kernels::findNewlyLoaded(blocks_.data() + first, sources_.data() + first, count, list);
        },
        found);
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
void ContactLanesOf<W>::load(std::uint32_t contact, const Contact& c, const MotionTable& motions,
                             const TickRows& rows)
{
    const std::uint32_t slot = laneOf_[contact];
    const auto lane = static_cast<int>(slot % W);
    const std::uint32_t bit = 1u << lane;
    Block& b = blocks_[slot / W];
    Source& s = sources_[slot / W];
    const auto set = [bit](std::uint32_t& bits, bool on) { bits = on ? bits | bit : bits & ~bit; };
    set(b.active, true);
    set(b.two, c.count == 2);
    set(s.elastic, c.restitution > 0);
    set(s.atImpact, c.atImpact);

    const Motion &mA = motions.rows[c.rowA], &mB = motions.rows[c.rowB];
    setLane(b.row.normal, lane, c.normal);
    setLane(b.row.invMassA, lane, mA.invMass);
    setLane(b.row.invMassB, lane, mB.invMass);
    b.row.invInertiaA.v[lane] = mA.invInertia;
    b.row.invInertiaB.v[lane] = mB.invInertia;
    b.row.friction.v[lane] = c.friction;
    b.row.surfaceSpeed.v[lane] = c.surfaceSpeed;
    b.row.blockInverse.v[lane] = 0;
    s.slowest.v[lane] = leastApproach(c, context_);
    setLane(s.start, lane, startBetween(rows, c.rowA, c.rowB));
    s.restGap.v[lane] = c.restGap;
    s.radiusA.v[lane] = c.radiusA;
    s.radiusB.v[lane] = c.radiusB;
    s.turns.v[lane] = c.count == 1 && normalTurns(c, c.points[0].anchor) ? -1 : 0;
    s.counted.v[lane] = 0;
    setLane(s.stepImpulse, lane, c.stepImpulse);
    for (int k = 0; k < 2; ++k) {
        const ContactPointRow& p = c.points[k];
        const bool present = k < c.count;
        s.present[k].v[lane] = present ? -1 : 0;
        s.cornerOnA[k].v[lane] = p.anchor.cornerOnA ? -1 : 0;
        setLane(s.localA[k], lane, present ? p.anchor.localA : Vec2{});
        setLane(s.localB[k], lane, present ? p.anchor.localB : Vec2{});
        b.row.points[k].normalImpulse.v[lane] = present ? p.normalImpulse : real(0);
        b.row.points[k].tangentImpulse.v[lane] = present ? p.tangentImpulse : real(0);
        s.stepNormal[k].v[lane] = p.stepNormal;
        s.stepTangent[k].v[lane] = p.stepTangent;
    }
}

template <int W>
LaneView ContactLanesOf<W>::view(std::uint32_t contact) const
{
    const std::uint32_t slot = laneOf_[contact];
    const auto lane = static_cast<int>(slot % W);
    const Block& b = blocks_[slot / W];
    const Source& s = sources_[slot / W];
    LaneView view;
    view.normal = laneOf(b.row.normal, lane);
    for (int k = 0; k < 2; ++k) {
        const PointRow<Lane<W>>& p = b.row.points[k];
        view.points[k] = {p.turnA.v[lane],
                          p.turnB.v[lane],
                          s.gap[k].v[lane],
                          p.normalInverse.v[lane] > 0,
                          (b.unloaded[k] >> lane & 1u) == 0,
                          p.normalImpulse.v[lane],
                          p.tangentImpulse.v[lane]};
        view.isLoaded = view.isLoaded || p.normalImpulse.v[lane] > 0;
    }
    return view;
}

template <int W>
void ContactLanesOf<W>::store(std::size_t slot, Contact& c) const
{
    const auto lane = static_cast<int>(slot % W);
    const Block& b = blocks_[slot / W];
    const Source& s = sources_[slot / W];
    c.normal = laneOf(b.row.normal, lane);
    c.stepImpulse = laneOf(s.stepImpulse, lane);
    for (int k = 0; k < c.count; ++k) {
        ContactPointRow& p = c.points[k];
        p.normalImpulse = b.row.points[k].normalImpulse.v[lane];
        p.tangentImpulse = b.row.points[k].tangentImpulse.v[lane];
        p.stepNormal = s.stepNormal[k].v[lane];
        p.stepTangent = s.stepTangent[k].v[lane];
    }
    if (solved_ && s.counted.v[lane] != 0) addToSums(c, 1);
}

// It moves nothing any more.
template <int W>
void ContactLanesOf<W>::drop(std::uint32_t contact)
{
    const std::uint32_t slot = laneOf_[contact];
    const auto lane = static_cast<int>(slot % W);
    Block& b = blocks_[slot / W];
    b.active &= ~(1u << lane);
    for (int k = 0; k < 2; ++k) {
        b.row.points[k].normalInverse.v[lane] = b.row.points[k].tangentInverse.v[lane] = 0;
        b.row.points[k].normalImpulse.v[lane] = b.row.points[k].tangentImpulse.v[lane] = 0;
        sources_[slot / W].present[k].v[lane] = 0;
    }
    b.row.blockInverse.v[lane] = 0;
}

template <int W>
void ContactLanesOf<W>::unload(std::uint32_t contact, Contact& c)
{
    const std::uint32_t slot = laneOf_[contact];
    store(slot, c);
    for (int k = 0; k < c.count; ++k)
        c.points[k].wasLoaded = (blocks_[slot / W].unloaded[k] >> slot % W & 1u) == 0;
    drop(contact);
}

template <int W>
void ContactLanesOf<W>::beginWhole(const std::vector<std::uint8_t>& quiet, real ticks)
{
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        Kernels::beginWhole(blocks_.data() + chunk.begin, chunk.end - chunk.begin, quiet.data(), ticks);
    });
}

template <int W>
void ContactLanesOf<W>::endWhole(real ticks)
{
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        Kernels::endWhole(blocks_.data() + chunk.begin, sources_.data() + chunk.begin,
                          chunk.end - chunk.begin, ticks);
    });
}

template <int W>
void ContactLanesOf<W>::comeIn()
{
    for (Block& b : blocks_) {
        b.active |= b.out;
        b.out = 0;
    }
}

// Block by block: two threads must not write lanes of one block.
template <int W>
void ContactLanesOf<W>::loadMarked(const std::vector<std::uint8_t>& marks, std::uint8_t mark,
                                   const Table<Contact>& contacts, const MotionTable& motions,
                                   const TickRows& rows)
{
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        for (std::size_t slot = chunk.begin * W; slot < chunk.end * W; ++slot) {
            const std::uint32_t contact = slots_[slot];
            if (contact != kNone && marks[contact] == mark) load(contact, contacts[contact], motions, rows);
        }
    });
}

template <int W>
void ContactLanesOf<W>::storeAll(Table<Contact>& rows) const
{
    parallel_.forEach(blocks_.size(), kGrain, [&](const Chunk& chunk) {
        for (std::size_t k = chunk.begin; k < chunk.end; ++k)
            for (std::size_t lane = 0; lane < W; ++lane)
                if ((blocks_[k].active >> lane & 1u) != 0) store(k * W + lane, rows[slots_[k * W + lane]]);
    });
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
