// SPDX-License-Identifier: MIT
#pragma once

#include "base/id_pool.hpp"
#include "narrowphase/convex.hpp"

#include <tamias2d/geometry/aabb.hpp>
#include <tamias2d/model/defs.hpp>

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Everything the world remembers of a shape.
struct ShapeRow {
    std::uint32_t body = 0;   // slot
    ShapeDef def;             // as given
    Convex convex;            // about the body's center of mass: follows when that moves
    Aabb sweptBox;            // holds the shape on its predicted way through the step   [m]
};

/// The shapes of a world; a row is the slot of the shape's id.
struct ShapeTable {
    explicit ShapeTable(std::uint32_t world) : ids(world) {}

    IdPool<ShapeId> ids;
    std::vector<ShapeRow> rows;
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
