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

/// By face of `core`: the least distance of the vertices of `other` in front of it.   [m]
class FaceDistances {
public:
    FaceDistances(const PlacedCore& core, const PlacedCore& other);
    real operator[](int face) const { return distances_[face]; }
    Lanes lanes(int face) const { return loadLane(distances_ + face); }

private:
    real distances_[kMaxPolygonVertices];  // only those of faces are ever written
};

/// Two placed cores, and the distances of each from the faces of the other.
struct FacedCores {
    const PlacedCore &a, &b;
    FaceDistances fromA, fromB;

    FacedCores(const PlacedCore& coreA, const PlacedCore& coreB)
        : a(coreA), b(coreB), fromA(coreA, coreB), fromB(coreB, coreA)
    {
    }
};

/// The face that separates the cores best (separating axis test). A face of B must beat those of A
/// by `preference`, so that rounding does not flip the choice between equals.
/// Only for pairs where at least one core has faces.
FaceQuery bestFace(const FacedCores& cores, real preference);

/// The closest features of two cores.
struct Separation {
    real distance;  ///< of the cores, along the normal; < 0 is overlap
    Vec2 normal;    ///< from A to B
    enum class Kind { FaceA, FaceB, Vertices } kind;
    int featureA, featureB;  ///< the face of the one (FaceA, FaceB), or both vertices
};

/// Separation by faces alone: never more than the true distance, and less only where two corners
/// face each other. Enough for sharp polygons.
Separation separationByFaces(const FacedCores& cores, real preference);

/// Its distance alone, with no preference.   [m]
real distanceByFaces(const FacedCores& cores);

/// The true distance, corners included: what rounded shapes need.
Separation exactSeparation(const FacedCores& cores, real preference);

}  // namespace tamias2d::inline TAMIAS_PRECISION
