// SPDX-License-Identifier: MIT
#pragma once

#include "solver/impact_stage.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// Makes the chains of contacts of each body, unless the step has them already.
void connect(ImpactStage& stage);

/// Pairs bodies again that are turned from the way their boxes were made for: by impacts, and by the passes.
class WayPairs {
public:
    /// `tickStart` is the start of the tick within the step [s]. The flights of the stage's scratch are by
    /// row.
    WayPairs(ImpactStage& stage, const StepContext& context, real tickStart)
        : stage_(stage), context_(context), scratch_(stage.scratch), tickStart_(tickStart)
    {
    }

    /// A body thrown out of the box it was paired in is paired again, at once: in one with some room around
    /// its new way, as what has been turned once is soon turned again. Returns the contacts that have come in
    /// and are to be looked at; those that do not meet as they are expected to go wait for the next tick.
    const std::vector<std::uint32_t>& pairAgain(std::uint32_t row);

private:
    ImpactStage& stage_;
    const StepContext& context_;
    ImpactScratch& scratch_;
    const real tickStart_;

    Motion& motion(std::uint32_t row) { return stage_.motions.rows[row]; }
    Trajectory pathOf(std::uint32_t row, Position origin);
    void expectWay(std::uint32_t row, const Trajectory& path, real room);
    void pairWithMoving(std::uint32_t row, std::uint32_t shape, const Aabb& needed, const Aabb& roomy);
    bool pairWithResting(std::uint32_t row, std::uint32_t shape, const Aabb& needed, const Aabb& roomy,
                         real end);
    bool meetsSleeper(std::uint32_t row, std::uint32_t shape, std::uint32_t other, real end);
    void notePartners(std::uint32_t row, std::uint32_t shape);
    void takeUp(std::uint32_t first);
    bool isKnown(std::uint32_t row, std::uint32_t shape, std::uint32_t other);
    void add(const ShapePair& pair, bool meets);
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
