// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/convex.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// A face of one of two cores, and how far the other core is in front of it.
struct FaceQuery {
    real distance;  ///< < 0: behind the face
    bool onA;
    int face;
};

/// min over the vertices of `other` of their distance in front of face `i` of `core`.
real faceDistance(const PlacedCore& core, int i, const PlacedCore& other);

/// The face that separates the cores best (separating axis test). A face of B must beat those of A
/// by `preference`, so that rounding does not flip the choice between equals.
/// Only for pairs where at least one core has faces.
FaceQuery bestFace(const PlacedCore& a, const PlacedCore& b, real preference);

/// The closest features of two cores.
struct Separation {
    real distance;  ///< of the cores, along the normal; < 0 is overlap
    Vec2 normal;    ///< from A to B
    enum class Kind { FaceA, FaceB, Vertices } kind;
    int featureA, featureB;  ///< the face of the one (FaceA, FaceB), or both vertices
};

/// Separation by faces alone: never more than the true distance, and less only where two corners
/// face each other. Enough for sharp polygons.
Separation separationByFaces(const PlacedCore& a, const PlacedCore& b, real preference);

/// The true distance, corners included: what rounded shapes need.
Separation exactSeparation(const PlacedCore& a, const PlacedCore& b, real preference);

}  // namespace tamias2d::inline TAMIAS_PRECISION
