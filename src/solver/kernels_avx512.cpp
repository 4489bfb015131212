// SPDX-License-Identifier: MIT
// The kernels for AVX-512.

#include "solver/body_kernels_of.hpp"
#include "solver/contact_kernels_of.hpp"
#include "solver/contact_step_kernels.hpp"
#include "solver/hinge_kernels_of.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

template struct BodyKernelsOf<kLanes64>;
template struct ContactKernels<kLanes64>;
template struct HingeKernels<kLanes64>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
