// SPDX-License-Identifier: MIT
#pragma once

#include "broadphase/rest_trees.hpp"
#include "geometry/cast.hpp"
#include "model/bodies.hpp"
#include "model/shapes.hpp"

#include <tamias2d/queries/queries.hpp>

#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where a shape's own frame is now.
struct ShapeFrame {
    Position origin;
    double angle;
    Rot rotation;

    DVec2 toLocal(Position world) const;
};

ShapeFrame frameOf(const BodyRow& body, const ShapeForm& shape);
Aabb boundsOf(const BodyRow& body, const ShapeForm& shape);
bool containsPoint(const BodyRow& body, const ShapeForm& shape, Position point);

/// What the searches look through: shapes of enabled bodies whose filter agrees. What holds still is found in
/// its trees; those of bodies that take part in steps are looked at one by one.
struct SearchSpace {
    const BodyTable& bodies;
    const ShapeTable& shapes;
    const RestTrees& resting;
    const Filter& filter;
};

/// Sorted.
std::vector<ShapeId> shapesAt(const SearchSpace& space, Position point);
std::vector<ShapeId> shapesIn(const SearchSpace& space, const Aabb& box);
/// Sorted by fraction, then by shape.
std::vector<RayHit> shapesAlong(const SearchSpace& space, Position from, Position to);

}  // namespace tamias2d::inline TAMIAS_PRECISION
