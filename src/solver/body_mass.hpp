// SPDX-License-Identifier: MIT
#pragma once

#include "model/motion.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// Of a body that is being solved, for sums over many; 0 of one that has no motion of that kind: pinned, or
/// beyond pushing.   [kg], [kg m^2]
inline double massOf(const Motion& m)
{
    const real inverse = m.greatestInvMass();
    return inverse > 0 ? 1 / static_cast<double>(inverse) : 0;
}
inline double inertiaOf(const Motion& m)
{
    return m.invInertia > 0 ? 1 / static_cast<double>(m.invInertia) : 0;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
