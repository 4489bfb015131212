// SPDX-License-Identifier: MIT
#pragma once

#include "scene/read_values.hpp"
#include "scene/write_values.hpp"

namespace tamias2d::inline TAMIAS_PRECISION::scene {

/// Reads the one key of a shape that says its geometry: circle, capsule, segment, box, polygon or
/// regularPolygon.
Geometry readGeometry(ObjectReader& shape);

/// Adds that key to a shape's object. A polygon that makeBox makes is written as a box.
void writeGeometry(OrderedJson& shape, const Geometry& geometry);

}  // namespace tamias2d::inline TAMIAS_PRECISION::scene
