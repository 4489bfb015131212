// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/lane_width.hpp>

#include <cstddef>

namespace tamias2d::inline TAMIAS_PRECISION {

/// The width that a world asks for or, where it leaves that open, the environment; Best if both do.
LaneWidth askedLanes(LaneWidth ofWorld) noexcept;

/// The width for a step of so many bodies. Best becomes the fastest: few bodies do not fill wide lanes, and
/// what is left of them costs as if they did.
LaneWidth suitedLanes(LaneWidth asked, std::size_t bodies) noexcept;

}  // namespace tamias2d::inline TAMIAS_PRECISION
