// SPDX-License-Identifier: MIT
// The kernels for what every machine has.

#include "solver/body_kernels_of.hpp"
#include "solver/contact_kernels_of.hpp"
#include "solver/contact_step_kernels.hpp"
#include "solver/hinge_kernels_of.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

template struct BodyKernelsOf<1>;
template struct ContactKernels<1>;
template struct HingeKernels<1>;
template struct BodyKernelsOf<kLanes16>;
template struct ContactKernels<kLanes16>;
template struct HingeKernels<kLanes16>;

}  // namespace tamias2d::inline TAMIAS_PRECISION
