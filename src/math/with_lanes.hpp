// SPDX-License-Identifier: MIT
#pragma once

#include "math/lane.hpp"

#include <tamias2d/base/lane_width.hpp>

#include <type_traits>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Calls visit(std::integral_constant<int, W>()) for the number W of lanes of a width; not Best.
template <class Visit>
auto withLanes(LaneWidth width, Visit visit)
{
    switch (width) {
    case LaneWidth::Bytes64:
        return visit(std::integral_constant<int, kLanes64>());
    case LaneWidth::Bytes32:
        return visit(std::integral_constant<int, kLanes32>());
    case LaneWidth::Scalar:
        return visit(std::integral_constant<int, 1>());
    case LaneWidth::Bytes16:
    case LaneWidth::Best:
        break;
    }
    return visit(std::integral_constant<int, kLanes16>());
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
