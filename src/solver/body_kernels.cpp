// SPDX-License-Identifier: MIT
#include "solver/body_kernels.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

const BodyKernels& bodyKernels(LaneWidth width)
{
    switch (width) {
    case LaneWidth::Bytes64:
        return BodyKernelsOf<kLanes64>::kTable;
    case LaneWidth::Bytes32:
        return BodyKernelsOf<kLanes32>::kTable;
    case LaneWidth::Scalar:
        return BodyKernelsOf<1>::kTable;
    case LaneWidth::Bytes16:
    case LaneWidth::Best:
        break;
    }
    return BodyKernelsOf<kLanes16>::kTable;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
