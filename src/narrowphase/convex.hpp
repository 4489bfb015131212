// SPDX-License-Identifier: MIT
#pragma once

#include "math/lane.hpp"

#include <tamias2d/geometry/shapes.hpp>
#include <tamias2d/math/transform.hpp>

#include <array>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Any shape as the narrow phase sees it: a convex core of 1 to 16 vertices, and everything within
/// `radius` of it. A circle has one vertex; capsules and segments two, and two faces back to back.
struct Convex {
    int count = 0;
    real radius = 0;   ///< [m]
    real extent = 0;   ///< farthest point from the frame's origin           [m]
    real size = 0;     ///< smallest width: the rest gap is a part of it     [m]
    // Both are filled up with copies of the last one: lanes read on beyond the count.
    std::array<Vec2, kMaxPolygonVertices> vertices;  ///< counter-clockwise, about the center of mass   [m]
    std::array<Vec2, kMaxPolygonVertices> normals;   ///< of the face from vertex i to i + 1, outwards

    int faces() const { return count > 1 ? count : 0; }
    bool isDisc() const
    {
        return count == 1 && vertices[0] == Vec2{};
    }   ///< about the origin: turning does nothing
};

/// The geometry in a frame at `center` of the body's: its own frame sits at `offset`, turned.
Convex makeConvex(const Geometry& geometry, Vec2 offset, Rot rotation, Vec2 center);

/// A pose relative to a nearby origin, so that `real` resolves it.
struct Pose {
    Vec2 p;
    Rot q;
};

using Lanes = Lane<kLanes>;

/// Room for as many vectors as a polygon may have, x and y apart for lanes. Only those in use are ever
/// written, and copies of the last one up to whole lanes.
class VectorRoom {
public:
    VectorRoom() noexcept {}  // leaves the room as it is: zeros would cost more than the placing
    Vec2 operator[](int i) const { return {x_[i], y_[i]}; }

    /// Those from `i` on, as many as there are lanes.
    BasicVec2<Lanes> lanes(int i) const { return {loadLane(x_ + i), loadLane(y_ + i)}; }
    void setLanes(int i, BasicVec2<Lanes> v)
    {
        storeLane(v.x, x_ + i);
        storeLane(v.y, y_ + i);
    }

private:
    real x_[kMaxPolygonVertices], y_[kMaxPolygonVertices];
};

/// A core in the coordinates of that origin.
struct PlacedCore {
    int count;
    VectorRoom vertices;
    VectorRoom normals;

    PlacedCore(const Convex& shape, const Pose& pose);
    int faces() const { return count > 1 ? count : 0; }
    int next(int i) const { return i + 1 < count ? i + 1 : 0; }
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
