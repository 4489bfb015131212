// SPDX-License-Identifier: MIT
// ContactLanes of one width: which contact is in which lane, and what each function needs of it. Included
// once, by contact_lane_seats.cpp; the reckoning is that of contact_kernels.hpp.
#pragma once

#include "solver/contact_kernels.hpp"
#include "solver/contact_lanes.hpp"

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
    ContactEndCounts conclude(const TickRows& rows, const StepContext& context, ContactTable& contacts,
                              std::vector<std::uint32_t>& changed) override;
    void tell(std::uint32_t contact, Contact& row) const override { tellOf(laneOf_[contact], row); }
    void tellAll(Table<Contact>& rows) const override;

    void loadMarked(const std::vector<std::uint8_t>& marks, std::uint8_t mark, const Table<Contact>& contacts,
                    const MotionTable& motions, const TickRows& rows) override;

    void prepare(TickRows& rows, const StepContext& context, std::vector<std::uint32_t>& open) override;
    void findApproaching(const TickRows& rows, const StepContext& context, real fastest,
                         std::vector<std::uint32_t>& found) const override;
    void findNewlyLoaded(std::vector<std::uint32_t>& found) const override;
    void keep() override { kept_ = blocks_; }
    void restore() override { blocks_ = kept_; }
    int colors() const override { return static_cast<int>(colorEnds_.size()); }
    void pass(int color, TickRows& rows, const std::uint8_t* visited, const UnrestNotes& unrest,
              real restless, bool ofAny) override
    {
        solved_ = true;
        eachChunk(color, [&](std::size_t first, std::size_t count, std::size_t) {
            Kernels::pass(blocks_.data() + first, count, rows, visited, unrest, restless, ofAny);
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
    std::vector<ContactEndCounts> ends_;     // likewise
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
    void tellOf(std::size_t slot, Contact& row) const;
    void leaveEmpty(std::size_t slot);
    std::size_t closeUp(std::uint32_t* list, std::size_t first, std::size_t end) const;
    template <class Find>
    void listAll(Find find, std::vector<std::uint32_t>& found) const;
    void place(std::uint32_t contact, const Contact& row, std::size_t slot, const MotionTable& motions,
               const Islands& islands);
};

}  // namespace
}  // namespace tamias2d::inline TAMIAS_PRECISION
