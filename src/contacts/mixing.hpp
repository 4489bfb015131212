// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/model/material.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// One value of a pair from the values of two materials and the rules they ask for.
real mixed(real a, real b, MixingRule ruleA, MixingRule ruleB, MixingRule worldRule) noexcept;

}  // namespace tamias2d::inline TAMIAS_PRECISION
