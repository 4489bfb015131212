// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/geometry/mass.hpp>
#include <tamias2d/geometry/shapes.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What the mass of a shape follows from, whatever its density.
struct Solid {
    double area = 0;    // [m^2]
    DVec2 center;       // [m]
    double second = 0;  // moment of the area about the center   [m^4]
};

/// Of a valid shape: nothing is checked.
Solid solidOf(const Geometry& geometry) noexcept;
MassProperties massOf(const Solid& solid, real density) noexcept;

}  // namespace tamias2d::inline TAMIAS_PRECISION
