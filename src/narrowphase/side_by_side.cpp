// SPDX-License-Identifier: MIT
#include "narrowphase/side_by_side.hpp"

#include "math/with_lanes.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

SpanOfWay::SpanOfWay(const Trajectory& path, real to)
    : start(path.rotation), end(path.aheadTime == to ? path.ahead : path.rotation),
      byVelocity(to * path.velocity), byAcceleration((to * to / 2) * path.acceleration),
      turn(absolute(path.turnBy(to) - path.turnBy(0)))
{
}

LaneKind laneKindOf(const Convex& a, const Convex& b)
{
    if (a.isDisc() && b.isDisc()) return LaneKind::Discs;
    if (!isSharpPair(a, b)) return LaneKind::None;
    const int corners = a.count > b.count ? a.count : b.count;
    return corners <= 4   ? LaneKind::Corners4
           : corners <= 6 ? LaneKind::Corners6
           : corners <= 8 ? LaneKind::Corners8
                          : LaneKind::None;
}

const PairKernels& pairKernels(LaneWidth width)
{
    return *withLanes(width, [](auto lanes) {
        constexpr int kWide = lanes() == 1 ? kLanes16 : lanes();
        return &PairKernelsOf<kWide>::kTable;
    });
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
