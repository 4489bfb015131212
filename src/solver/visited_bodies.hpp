// SPDX-License-Identifier: MIT
#pragma once

#include "model/contacts.hpp"
#include "solver/body_kernels.hpp"

#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Rows of the MotionTable.
struct BodyChunk {
    std::uint32_t begin, end;
};

/// The bodies that a tick visits. Nothing asks where a lone one is before the step is over: one that has no
/// pair in it, carries nothing and goes exactly as it was expected to. All its ticks are done together when
/// the step ends, in registers; or as far as the step has come, if it gets a pair after all. That gives the
/// bits of doing tick by tick what is done with visited ones.
///
/// Nor does a tick visit those that are quiet (solver/quiet_bodies.hpp), but for the one that stands for all.
class VisitedBodies {
public:
    /// Before the first tick. Facts and rows of contacts are the same, one by one. If `all`, nobody is lone.
    void begin(const Table<Motion>& motions, const ContactTable& contacts, const StepContext& context,
               bool all);
    /// The visited ones, in order. Rows that have come in since begin() are.
    const std::vector<BodyChunk>& chunks(std::size_t rows);
    /// Calls body(BodyRows) for each of them.
    template <class Body>
    void forEach(Parallel& parallel, Table<Motion>& motions, TickRows& rows, Body&& body)
    {
        const std::vector<BodyChunk>& all = chunks(motions.size());
        parallel.forEach(all.size(), 1, [&](const Chunk& chunk) {
            body(BodyRows{motions.data(), rows, all[chunk.begin].begin, all[chunk.begin].end});
        });
    }
    /// From here on the body is visited: brought to where it is in the tick `tick`, once that has started.
    void visit(std::uint32_t row, const BodyKernels& kernels, Table<Motion>& motions, TickRows& rows,
               const StepContext& context, int tick);
    /// From here on only those are visited that are `quiet`, by row, or only others.
    void choose(const std::vector<std::uint8_t>& quiet, bool isQuiet);
    const std::vector<std::uint8_t>& quiet() const { return quiet_; }
    bool anyQuiet() const { return !quiet_.empty(); }
    bool isQuiet(std::uint32_t row) const { return row < quiet_.size() && quiet_[row] != 0; }
    bool isLone(std::uint32_t row) const { return isVisited_[row / kBlock] == 0; }
    /// From here on it is visited as those that are not.
    void wake(std::uint32_t row);
    /// All lone ones are.
    void visitAll(const BodyKernels& kernels, Table<Motion>& motions, TickRows& rows,
                  const StepContext& context, int tick);
    /// When the last tick has ended: the ticks of all lone ones.
    void end(const BodyKernels& kernels, Table<Motion>& motions, TickRows& rows, const StepContext& context,
             Parallel& parallel);

private:
    static constexpr std::uint32_t kBlock = 16;  // rows: as many as the widest lanes
    static constexpr std::uint32_t kLoneGrain = 64;  // rows that stay in the nearest cache through all ticks

    std::vector<std::uint8_t> isVisited_;  // by block; the last one always is, as rows are added to it
    std::vector<std::uint8_t> quiet_;  // by row; empty if none is
    bool visitsQuiet_ = false;
    std::vector<BodyChunk> chunks_, lone_;
    std::size_t listed_ = 0;  // rows that chunks_ is a list of
    bool stale_ = true;  // are the chunks to be listed again?

    void list(bool lone, std::uint32_t rows, std::uint32_t most, std::vector<BodyChunk>& into) const;
    void listVisited(std::uint32_t rows);
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
