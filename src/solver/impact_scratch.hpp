// SPDX-License-Identifier: MIT
#pragma once

#include "broadphase/tree.hpp"
#include "contacts/update.hpp"
#include "solver/flight.hpp"

#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// An impact that awaits its turn.
struct DueImpact {
    Impact impact;
    int before;              // impacts of the contact so far: of those at one time, take turns
    std::uint32_t place;     // of the contact in the order of solving
    std::uint32_t version;   // of the contact's motion when it was found

    bool operator<(const DueImpact& other) const  // the heap has the greatest on top
    {
        if (impact.time != other.impact.time) return impact.time > other.impact.time;
        return before != other.before ? before > other.before : place > other.place;
    }
};

/// The contacts of each body, as chains through the contacts: each is in two of them, as A's and as B's.
class ContactChains {
public:
    static constexpr std::uint32_t kEnd = 0xffffffffu;

    void reset(std::size_t rows)
    {
        ends_.assign(rows, {kEnd, kEnd});
        next_.clear();
    }
    /// Makes room for rows that have come in.
    void grow(std::size_t rows) { ends_.resize(rows, {kEnd, kEnd}); }
    /// Appends a link of contact `i` to the chain of `row`; side 0 is A's, 1 is B's.
    void append(std::uint32_t row, std::uint32_t i, std::uint32_t side)
    {
        const std::uint32_t link = 2 * i + side;
        if (next_.size() <= link) next_.resize(2 * (std::size_t{i} + 1), kEnd);
        Ends& ends = ends_[row];
        (ends.first == kEnd ? ends.first : next_[ends.last]) = link;
        ends.last = link;
    }
    std::uint32_t first(std::uint32_t row) const { return ends_[row].first; }
    std::uint32_t next(std::uint32_t link) const { return next_[link]; }
    static std::uint32_t contactOf(std::uint32_t link) { return link / 2; }

private:
    struct Ends {
        std::uint32_t first, last;
    };
    std::vector<Ends> ends_;            // by row
    std::vector<std::uint32_t> next_;   // by link
};

/// The shapes that one shape has contacts with: for many questions about one that has many.
class Partners {
public:
    void forget() { noted_ = false; }
    bool areNoted() const { return noted_; }
    void begin(std::size_t shapes)
    {
        noted_ = true;
        if (++number_ == 0) numbers_.assign(numbers_.size(), 0), number_ = 1;
        numbers_.resize(shapes, 0);
    }
    void note(std::uint32_t shape) { numbers_[shape] = number_; }
    bool has(std::uint32_t shape) const { return numbers_[shape] == number_; }

private:
    std::vector<std::uint32_t> numbers_;  // by slot of the shape: when it was noted last
    std::uint32_t number_ = 0;
    bool noted_ = false;
};

/// What is asked of a contact whenever a body of it is turned from its way, all of them side by side.
struct PairRow {
    std::uint32_t rowA, rowB;   // of the MotionTable
    Apart apart;  // at the start of the tick, at least; of those that are not swept nothing is known
    real near;  // gap from which on it gets no manifold, and a little for rounding   [m]
    bool swept;  // as that of Contact
    bool placed;  // have its points been placed in this tick?
    std::uint32_t version;  // of its motion in this tick
    real farUntil;  // it meets nowhere in this tick while its bodies have strayed by less, in sum   [m]
};

/// What is known of bodies that joints turn from the way a tick was begun for: turned_contacts.hpp.
struct TurnedScratch {
    std::vector<std::uint8_t> wild;  // by island: is a body of it faster than any may be?
    std::vector<std::uint32_t> contacts;  // that they are turned onto
    std::vector<std::uint8_t> islands;  // of those, by island
    std::vector<std::uint32_t> grounds;  // by group of joints: the row of one that it has a contact with
    std::vector<real> parts;  // by group: how fast it may still go against that, of how fast it would
};

/// What the impact stage works with; it keeps its memory from step to step.
struct ImpactScratch {
    explicit ImpactScratch(LaneWidth lanes) : paths(lanes) {}

    ExpectedPaths paths;  // of bodies within the tick, before any impact
    std::vector<std::uint8_t> verdicts;  // on swept contacts, see resweepForTick
    std::vector<std::uint32_t> again;  // those whose ways are to be looked at
    Table<PairRow> pairs;  // by contact
    std::vector<std::uint32_t> exhausted;  // searches that ran out of iterations, by chunk
    Table<Flight> flights;  // by row, of those that
    std::vector<std::uint8_t> flies;  // by row: has its flight through this tick been asked for?
    std::vector<std::uint32_t> strays;  // rows that leave their boxes in this tick
    TurnedScratch turned;
    int tick = 0;  // the one that has started last
    bool kicked = false;  // has an impact acted in it?
    struct Start {
        real fastest;
        std::size_t strays;
    };
    std::vector<Start> starts;  // of a tick, by chunk of the bodies
    real fastest = 0;  // no point of any body is faster in the tick   [m/s]
    Table<ImpactPoint> points;  // two for each contact
    bool connected = false;  // have the chains been made in this step?
    ContactChains chains;  // of bodies that move; made at the first impact of a step
    std::vector<std::uint32_t> swept;  // contacts that are looked at again in every tick
    BoxTree tree;  // over the boxes of the step; made when a body leaves its own
    std::vector<std::uint32_t> found;  // boxes
    Partners partners;  // of the shape that is paired again
    std::vector<std::uint32_t> met;  // contacts that have come in and meet
    std::vector<DueImpact> queue;  // a heap
    std::vector<std::uint32_t> woken, wokenContacts;  // rows, contacts: quiet until now
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
