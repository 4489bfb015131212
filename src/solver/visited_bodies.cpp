// SPDX-License-Identifier: MIT
#include "solver/visited_bodies.hpp"

#include "solver/integrate.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Will it go as it is expected to, whatever others do? Not if damping or a bound of speed may bend its way. A
// load that it has lost is forgotten in the first tick.
bool fliesAlone(const Motion& m, const StepContext& context)
{
    const real time = static_cast<real>(context.dt);
    const real speed = absolute(m.velocity.x) + absolute(m.velocity.y) +
                       time * (absolute(m.acceleration.x) + absolute(m.acceleration.y));
    const real spin = absolute(m.spin) + time * absolute(m.spinRate);
    return m.moves() && !m.isLoaded() && !m.isDamped() && m.steady == Vec2{} && m.steadySpin == 0 &&
           speed < mostSpeed(context.lengthUnit) && spin < mostSpin();
}

// Appends rows; in chunks of at most so many.
void append(std::uint32_t begin, std::uint32_t end, std::uint32_t most, std::vector<BodyChunk>& chunks)
{
    if (!chunks.empty() && chunks.back().end == begin && end - chunks.back().begin <= most)
        chunks.back().end = end;
    else
        chunks.push_back({begin, end});
}

}  // namespace

void VisitedBodies::begin(const Table<Motion>& motions, const ContactTable& contacts,
                          const StepContext& context, bool all)
{
    const std::size_t blocks = (motions.size() + kBlock - 1) / kBlock;
    isVisited_.assign(blocks, all ? 1 : 0);
    chunks_.reserve(isVisited_.capacity());
    lone_.reserve(isVisited_.capacity());
    quiet_.clear();
    stale_ = true;
    if (all || blocks == 0) return;
    isVisited_.back() = 1;
    for (const ContactFacts& of : contacts.facts)
        isVisited_[of.rowA / kBlock] = isVisited_[of.rowB / kBlock] = 1;
    for (std::size_t row = 0; row < motions.size(); ++row) {
        std::uint8_t& is = isVisited_[row / kBlock];
        if (is == 0 && !fliesAlone(motions[row], context)) is = 1;
    }
}

// The rows of all blocks that are lone, or not.
void VisitedBodies::list(bool lone, std::uint32_t rows, std::uint32_t most,
                         std::vector<BodyChunk>& into) const
{
    into.clear();
    for (std::uint32_t begin = 0; begin < rows; begin += kBlock)
        if (isLone(begin) == lone) append(begin, minimum(begin + kBlock, rows), most, into);
}

void VisitedBodies::listVisited(std::uint32_t rows)
{
    if (!anyQuiet()) {
        list(false, rows, kBodyGrain, chunks_);
        return;
    }
    chunks_.clear();
    for (std::uint32_t first = 0; first < rows; first += kBlock) {
        if (isLone(first)) continue;
        const std::uint32_t end = minimum(first + kBlock, rows);
        for (std::uint32_t begin = first; begin < end;) {
            while (begin < end && isQuiet(begin) != visitsQuiet_) ++begin;
            const std::uint32_t from = begin;
            while (begin < end && isQuiet(begin) == visitsQuiet_) ++begin;
            if (begin > from) append(from, begin, kBodyGrain, chunks_);
        }
    }
}

const std::vector<BodyChunk>& VisitedBodies::chunks(std::size_t rows)
{
    if (!stale_ && listed_ == rows) return chunks_;
    isVisited_.resize((rows + kBlock - 1) / kBlock, 1);
    listVisited(static_cast<std::uint32_t>(rows));
    listed_ = rows;
    stale_ = false;
    return chunks_;
}

void VisitedBodies::choose(const std::vector<std::uint8_t>& quiet, bool isQuiet)
{
    quiet_.reserve(quiet.capacity());
    quiet_.assign(quiet.begin(), quiet.end());
    chunks_.reserve(quiet.capacity() / 2 + 1);
    visitsQuiet_ = isQuiet;
    stale_ = true;
}

void VisitedBodies::wake(std::uint32_t row)
{
    quiet_[row] = 0;
    stale_ = true;
}

void VisitedBodies::visit(std::uint32_t row, const BodyKernels& kernels, Table<Motion>& motions,
                          TickRows& rows, const StepContext& context, int tick)
{
    const std::uint32_t block = row / kBlock;
    if (block >= isVisited_.size() || isVisited_[block] != 0) return;
    isVisited_[block] = 1;
    stale_ = true;
    const BodyRows bodies{motions.data(), rows, block * kBlock, (block + 1) * kBlock};
    kernels.fly(bodies, context, tick);
    std::uint32_t none[kBlock];  // nobody strays
    StrayList strays{none, 0};
    kernels.startTick(bodies, context, timeOf(tick, context), strays);
}

void VisitedBodies::visitAll(const BodyKernels& kernels, Table<Motion>& motions, TickRows& rows,
                             const StepContext& context, int tick)
{
    for (std::uint32_t block = 0; block < isVisited_.size(); ++block)
        visit(block * kBlock, kernels, motions, rows, context, tick);
}

void VisitedBodies::end(const BodyKernels& kernels, Table<Motion>& motions, TickRows& rows,
                        const StepContext& context, Parallel& parallel)
{
    const auto count = static_cast<std::uint32_t>(motions.size());
    list(true, count, kLoneGrain, lone_);
    parallel.forEach(lone_.size(), 1, [&](const Chunk& chunk) {
        const auto [begin, end] = lone_[chunk.begin];
        kernels.fly({motions.data(), rows, begin, end}, context, context.ticks);
    });
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
