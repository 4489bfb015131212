// SPDX-License-Identifier: MIT
#include "solver/visited_bodies.hpp"

#include "solver/integrate.hpp"

#include <atomic>

namespace tamias2d::inline TAMIAS_PRECISION {
namespace {

// Will it go as it is expected to, whatever others do? Not if damping or a bound of speed may bend its way.
bool fliesAlone(const Motion& m, const StepContext& context)
{
    const real time = static_cast<real>(context.dt);
    const real speed = absolute(m.velocity.x) + absolute(m.velocity.y) +
                       time * (absolute(m.acceleration.x) + absolute(m.acceleration.y));
    const real spin = absolute(m.spin) + time * absolute(m.spinRate);
    return m.moves() && !m.isDamped() && m.steady == Vec2{} && m.steadySpin == 0 &&
           speed < mostSpeed(context.lengthUnit) && spin < mostSpin();
}

// The ticks of lone bodies before the one with that number.
std::uint32_t fly(const BodyChunk& chunk, const BodyKernels& kernels, Table<Motion>& motions, TickRows& rows,
                  const StepContext& context, int ticks)
{
    const BodyRows bodies{motions.data(), rows, chunk.begin, chunk.end};
    std::uint32_t clamped = 0;
    for (int tick = 0; tick < ticks; ++tick) {
        kernels.kick(bodies, context, false);
        kernels.drift(bodies, context, false, false);
        clamped += kernels.kickAfterDrift(bodies, context, false, false);
    }
    return clamped;
}

}  // namespace

void VisitedBodies::begin(const Table<Motion>& motions, const ContactTable& contacts,
                          const StepContext& context, bool all)
{
    const std::size_t blocks = (motions.size() + kBlock - 1) / kBlock;
    isVisited_.assign(blocks, all ? 1 : 0);
    chunks_.reserve(isVisited_.capacity());
    lone_.reserve(isVisited_.capacity());
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

// The rows of all blocks that are `visited` or not, in chunks of at most so many.
void VisitedBodies::list(std::uint8_t visited, std::uint32_t rows, std::uint32_t most,
                         std::vector<BodyChunk>& into) const
{
    into.clear();
    for (std::uint32_t block = 0; block < isVisited_.size(); ++block) {
        if (isVisited_[block] != visited) continue;
        const std::uint32_t begin = block * kBlock, end = minimum(begin + kBlock, rows);
        if (!into.empty() && into.back().end == begin && end - into.back().begin <= most)
            into.back().end = end;
        else
            into.push_back({begin, end});
    }
}

const std::vector<BodyChunk>& VisitedBodies::chunks(std::size_t rows)
{
    const bool grows = chunks_.empty() ? rows > 0 : chunks_.back().end != rows;
    if (!stale_ && !grows) return chunks_;
    isVisited_.resize((rows + kBlock - 1) / kBlock, 1);
    list(1, static_cast<std::uint32_t>(rows), kBodyGrain, chunks_);
    stale_ = false;
    return chunks_;
}

std::uint32_t VisitedBodies::visit(std::uint32_t row, const BodyKernels& kernels, Table<Motion>& motions,
                                   TickRows& rows, const StepContext& context, int tick)
{
    const std::uint32_t block = row / kBlock;
    if (block >= isVisited_.size() || isVisited_[block] != 0) return 0;
    isVisited_[block] = 1;
    stale_ = true;
    const BodyChunk chunk{block * kBlock, (block + 1) * kBlock};
    const std::uint32_t clamped = fly(chunk, kernels, motions, rows, context, tick);
    std::uint32_t none[kBlock];  // nobody strays
    StrayList strays{none, 0};
    kernels.startTick({motions.data(), rows, chunk.begin, chunk.end}, context, timeOf(tick, context), strays);
    return clamped;
}

std::uint32_t VisitedBodies::visitAll(const BodyKernels& kernels, Table<Motion>& motions, TickRows& rows,
                                      const StepContext& context, int tick)
{
    std::uint32_t clamped = 0;
    for (std::uint32_t block = 0; block < isVisited_.size(); ++block)
        clamped += visit(block * kBlock, kernels, motions, rows, context, tick);
    return clamped;
}

std::uint32_t VisitedBodies::end(const BodyKernels& kernels, Table<Motion>& motions, TickRows& rows,
                                 const StepContext& context, Parallel& parallel)
{
    list(0, static_cast<std::uint32_t>(motions.size()), kLoneGrain, lone_);
    std::atomic<std::uint32_t> clamped = 0;
    parallel.forEach(lone_.size(), 1, [&](const Chunk& chunk) {
        clamped += fly(lone_[chunk.begin], kernels, motions, rows, context, context.ticks);
    });
    return clamped;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
