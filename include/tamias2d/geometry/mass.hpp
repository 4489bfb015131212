// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/geometry/shapes.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// How a shape or a body resists being moved [DD1, DD14].
struct MassProperties {
    real mass = 0;     ///< [kg]
    Vec2 center = {};  ///< of mass                      [m]
    real inertia = 0;  ///< about that center            [kg*m^2]
};

/// The area of a shape, rounding included. Zero for a segment without rounding.        [m^2]
real area(const Geometry& geometry);
/// The center of that area.                                                            [m]
Vec2 centroid(const Geometry& geometry);
/// Mass, center and moment of inertia about the center, for a density [kg/m^2] >= 0.
MassProperties massProperties(const Geometry& geometry, real density);
/// Is the point in the shape or on its border? Both in the shape's frame [T5].          [m]
bool containsPoint(const Geometry& geometry, Vec2 point);

}  // namespace tamias2d::inline TAMIAS_PRECISION
