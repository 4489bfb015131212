// SPDX-License-Identifier: MIT
// The kernels for AVX2.

#include "narrowphase/side_by_side_of.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

template struct PairKernelsOf<kLanes32>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
