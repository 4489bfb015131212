// SPDX-License-Identifier: MIT
// The kernels for what every machine has.

#include "narrowphase/side_by_side_of.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

template struct PairKernelsOf<kLanes16>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
