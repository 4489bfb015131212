// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/convex.hpp"

namespace tamias2d::test {

/// A shape as the narrow phase takes it, of a body that stands at the origin.
inline Convex convexOf(const Geometry& geometry)
{
    return makeConvex(geometry, {}, {}, {});
}

}  // namespace tamias2d::test
