// SPDX-License-Identifier: MIT
// Which groups of joints are solved at once: docs/theory/joints.md, section 7.
#pragma once

#include "joints/tick.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// Says so for each group of a new list, and what else is to be known of them.
void chooseStiff(JointTable& table, const Table<Motion>& motions, JointSystem& system);

/// The joints of stiff groups, and the order in which their bodies are eliminated.
void orderStiff(const Table<Motion>& motions, JointSystem& system);

}  // namespace tamias2d::inline TAMIAS_PRECISION
