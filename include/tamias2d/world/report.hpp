// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/config.hpp>
#include <tamias2d/model/clamps.hpp>

#include <cstdint>

namespace tamias2d::inline TAMIAS_PRECISION {

enum class StepStatus : std::uint8_t {
    Done,
    BadTimeStep,  ///< dt was not in [1e-12, 1] s, or substeps not in [1, 256]: nothing moved
};

/// Wall-clock time of the stages of one step, for profiles only.   [ms]
struct StageTimes {
    double pairs = 0;      ///< broad phase
    double manifolds = 0;  ///< narrow phase
    double graph = 0;      ///< coloring and islands
    double impacts = 0;    ///< impulses at their time of impact, swept pairs
    double solve = 0;      ///< kicks, drift, contact passes, calming
    double finalize = 0;   ///< touches, read-back, boxes
    double total = 0;
};

/// What one step did.
struct StepReport {
    StepStatus status = StepStatus::Done;
    int substeps = 0;
    std::uint32_t bodies = 0;            ///< enabled ones
    std::uint32_t dynamicBodies = 0;
    std::uint32_t awake = 0;             ///< dynamic ones that take part in steps
    std::uint32_t quiet = 0;  ///< of those: at rest, they made the step in one tick (Tuning::quiet)
    std::uint32_t asleep = 0;            ///< dynamic ones at rest, which cost nothing
    std::uint32_t shapes = 0;            ///< of enabled bodies
    std::uint32_t pairs = 0;             ///< of shapes whose swept boxes overlap, one of a body awake
    std::uint32_t sweptPairs = 0;        ///< looked at again in every tick (half sub-step)
    std::uint32_t touching = 0;          ///< contacts that touch at the end, asleep or not
    std::uint32_t impacts = 0;  ///< impulses at their time of impact: hits but for the simultaneous ones
    std::uint32_t repaired = 0;  ///< pairs added because an impact threw a body out of its swept box
    std::uint32_t islands = 0;  ///< groups of movable bodies that touch or bear each other; one alone counts
    std::uint32_t joints = 0;  ///< at work: enabled, between enabled bodies
    std::uint32_t stiffGroups = 0;  ///< groups of joints, piles of heavy on light, solved at once
    std::uint32_t stiffFallbacks = 0;  ///< visits to such a group that found no solution: joints one by one
    std::uint32_t nonFinite = 0;  ///< bodies set aside (disabled) as a value of theirs was no number
    std::uint32_t jointFaults = 0;  ///< answers of joints of your own that threw or were none that can be
    std::uint32_t forceLawFaults = 0;  ///< force laws that threw or returned no number
    double deepestOverlap = 0;  ///< of bodies awake, at the end of the step   [m]   >= 0
    ClampCounts clamps;
    StageTimes times;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
