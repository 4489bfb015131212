// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/separation.hpp"

#include <cstdint>
#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {

/// One point of a manifold: a point of each core, fixed in its body.
struct ManifoldPoint {
    Vec2 localA, localB;        ///< in the body's frame, about its center of mass   [m]
    bool cornerOnA = false;     ///< whose corner it is; the other side slides past it
    bool roundOnRound = false;  ///< two roundings: the normal runs through both points
    std::uint32_t feature = 0;  ///< which corner and face; stays the same while they meet
};

/// How two shapes meet: one normal and one or two points.
struct Manifold {
    Vec2 normal;                ///< from A to B
    int count = 0;
    ManifoldPoint points[2];
    real time = 0;              ///< of the pose it was taken at, within the sweep   [s]
    bool atImpact = false;      ///< taken where a swept pair meets
};

/// A direction along which two shapes are apart: between them lies a strip of that width across it.
struct Apart {
    Vec2 axis;                                      ///< from A to B
    real gap = -std::numeric_limits<real>::max();   ///< [m]; lowest: nothing is known
};

/// The feature of a corner of the other core, or of the `cut` end of the face (1 or 2), at a face.
inline std::uint32_t featureOf(int corner, int cut, bool faceOnA, int face)
{
    return static_cast<std::uint32_t>((cut == 0 ? corner : 16 * cut) | (faceOnA ? 0 : 64) | (face << 7));
}

/// Two shapes placed at one moment: all that a manifold is made of.
struct PlacedPair {
    const Convex &a, &b;
    Pose poseA, poseB;
    PlacedCore coreA, coreB;
    FacedCores cores;

    PlacedPair(const Convex& shapeA, const Pose& atA, const Convex& shapeB, const Pose& atB)
        : a(shapeA), b(shapeB), poseA(atA), poseB(atB), coreA(shapeA, atA), coreB(shapeB, atB),
          cores(coreA, coreB)
    {
    }
    PlacedPair(const PlacedPair&) = delete;  // `cores` refers to what stands here
};

/// The manifold of a reference face and the edge that faces it, clipped. False if that edge lies
/// beyond the ends of the face; with `force` it then has the one point nearest to it.
bool faceManifold(const PlacedPair& pair, bool faceOnA, int face, bool force, Manifold& manifold);

/// The manifold of the closest features, at one pose; of those at hand.
void closestManifold(const PlacedPair& pair, real preference, Manifold& manifold);
void closestManifold(const PlacedPair& pair, const Separation& nearest, Manifold& manifold);

/// The one point of two vertices that are nearest to each other.
void vertexManifold(const Convex& a, const Convex& b, const Separation& nearest, Manifold& manifold);

/// The separation that suits the pair: by faces for sharp polygons, exact for rounded shapes.
/// Radii are not subtracted.
Separation coreSeparation(const PlacedPair& pair, real preference);

/// Its distance alone, with no preference.   [m]
real coreDistance(const PlacedPair& pair);

/// Are both sharp, and not both lines? Then faces alone tell how far apart they are.
bool isSharpPair(const Convex& a, const Convex& b);

}  // namespace tamias2d::inline TAMIAS_PRECISION
