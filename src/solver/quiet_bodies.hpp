// SPDX-License-Identifier: MIT
#pragma once

#include "solver/impact_stage.hpp"

#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Who is quiet, and what finding out works with; it keeps its memory from step to step.
struct QuietScratch {
    std::vector<std::uint32_t> parent;     // by row: bodies that are company by pairs, as disjoint sets
    std::vector<std::uint8_t> states;      // by row
    bool parentIsStale = true;
    std::vector<std::uint8_t> restless;    // by row of who leads a company
    std::vector<std::uint8_t> quiet;       // by row: it is, or is a ground that holds still
};

/// Before the first tick: who makes the step in one tick as well as in all. A body at rest whose loads
/// balance what acts on it, in the company of such bodies and of grounds that hold still. `same`: contacts
/// are those of the step before; `varies`: the forces on some bodies change within it. Returns whether anyone
/// is. docs/theory/calm.md, section 6.
bool findQuiet(ImpactStage& stage, const StepContext& context, bool same, bool varies, QuietScratch& scratch);
/// How many bodies still are.
std::uint32_t countQuiet(const VisitedBodies& visited, const QuietScratch& scratch);

/// Before something that is not of its company meets a quiet body: it and all its company are in the ticks
/// again, from the start of the one at hand on.
void wakeQuiet(ImpactStage& stage, std::uint32_t row, const StepContext& context);

}  // namespace tamias2d::inline TAMIAS_PRECISION
