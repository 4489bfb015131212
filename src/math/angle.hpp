// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/math/vec2.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The angle by which `from` must turn counter-clockwise to point along `to`, in [0, 2 pi), within
/// 4 ulp of 1; neither may be zero. The same bits on every platform [ADR6].   [rad]
double angleBetween(DVec2 from, DVec2 to) noexcept;

}  // namespace tamias2d::inline TAMIAS_PRECISION
