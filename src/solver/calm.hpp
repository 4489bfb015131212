// SPDX-License-Identifier: MIT
#pragma once

#include "islands/links.hpp"
#include "model/motion.hpp"
#include "model/step_context.hpp"

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Velocity change of one body by contacts and forces in a tick.
struct TickChange {
    Vec2 velocity;   // [m/s]
    real spin = 0;   // [rad/s]
};

/// Slows loaded bodies that are already slow and not speeding up, against the ground their island
/// stands on, or against the island's own motion, whose momentum is kept. docs/theory/calm.md.
void calm(std::vector<Motion>& rows, const std::vector<TickChange>& changes, const Islands& islands,
          const StepContext& context);

}  // namespace tamias2d::inline TAMIAS_PRECISION
