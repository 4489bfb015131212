// SPDX-License-Identifier: MIT
#include "solver/body_kernels.hpp"

#include "math/with_lanes.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

const BodyKernels& bodyKernels(LaneWidth width)
{
    return *withLanes(width, [](auto lanes) { return &BodyKernelsOf<lanes()>::kTable; });
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
