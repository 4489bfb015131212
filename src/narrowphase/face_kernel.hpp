// SPDX-License-Identifier: MIT
// The formulas of a face and the edge that meets it, for one pair (T = real) and for several at once (T =
// Lane): the same operations in the same order, so the same bits. Derivation: docs/theory/contacts.md,
// section 2.
#pragma once

#include "math/lane.hpp"

#include <tamias2d/math/scalar.hpp>
#include <tamias2d/math/transform.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

template <class T>
using MaskOf = decltype(T() < T());

template <class T>
BasicVec2<T> select(MaskOf<T> condition, BasicVec2<T> a, BasicVec2<T> b)
{
    return {select(condition, a.x, b.x), select(condition, a.y, b.y)};
}

/// In rest gaps, how far two that all but touch may move against each other in a sweep and yet press on each
/// other, all along it, with the features that are nearest at its start.
inline constexpr real kSlowest = 16;

/// In rest gaps, how much deeper behind a face than behind the nearest one two that overlap may be for that
/// face to part them: by more, it lies on the far side, where the way leads through.
inline constexpr real kThrough = 64;

/// What a face is worth that is `nearest` away over a sweep: of faces that nearly tie, the one along which
/// the other shape slides.   [m]
template <class T>
T faceScore(T nearest, BasicVec2<T> normal, BasicVec2<T> slide, T deep, T restGap)
{
    const T along = minimum(absolute(dot(normal, slide)), restGap);
    return select(nearest > deep, nearest - along, nearest);
}

/// The edge that faces a reference face, clipped to it. `far` lies farther along the face than `near`.
template <class T>
struct ClippedEdge {
    BasicVec2<T> far, near;
    MaskOf<T> swapped;             // `far` is the start of the edge, else its end
    MaskOf<T> farCut, nearCut;     // cut off at an end of the face
    MaskOf<T> beyond,
        before;     // the edge lies beyond the ends of the face and is not clipped; before its origin
    MaskOf<T> single;              // the two are one
};

/// The face runs from `origin` to `next` and has the normal `n`; the edge runs from `start` to `end`.
template <class T>
ClippedEdge<T> clipEdge(BasicVec2<T> n, BasicVec2<T> origin, BasicVec2<T> next, BasicVec2<T> start,
                        BasicVec2<T> end)
{
    const T zero(real(0));
    const BasicVec2<T> tangent = perpendicular(n);
    const T faceLength = dot(tangent, next - origin);
    const T startAlong = dot(tangent, start - origin), endAlong = dot(tangent, end - origin);

    // The edge runs against the face: its start is `far`, but for rounding.
    ClippedEdge<T> clip;
    clip.swapped = startAlong < endAlong;
    const BasicVec2<T> far = select(clip.swapped, end, start), near = select(clip.swapped, start, end);
    const T farAlong = select(clip.swapped, endAlong, startAlong);
    const T nearAlong = select(clip.swapped, startAlong, endAlong);
    clip.before = farAlong < zero;
    clip.beyond = clip.before | (nearAlong > faceLength);

    const BasicVec2<T> along = near - far;
    const T span = farAlong - nearAlong;
    const MaskOf<T> slanted = (!clip.beyond) & (span > zero);
    clip.farCut = slanted & (farAlong > faceLength);
    clip.nearCut = slanted & (nearAlong < zero);
    clip.far = select(clip.farCut, far + ((farAlong - faceLength) / span) * along, far);
    clip.near = select(clip.nearCut, far + (farAlong / span) * along, near);
    const BasicVec2<T> d = clip.far - clip.near;
    clip.single = clip.beyond | (dot(d, d) < T(real(1e-12)) * faceLength * faceLength);
    return clip;
}

/// The point of the face's line nearest to `point`.
template <class T>
BasicVec2<T> footOn(BasicVec2<T> n, BasicVec2<T> origin, BasicVec2<T> point)
{
    return point - dot(n, point - origin) * n;
}

/// A pose of one body or of several.
template <class T>
struct BasicPose {
    BasicVec2<T> p;
    T c, s;   // cosine and sine

    BasicVec2<T> at(BasicVec2<T> local) const { return p + rotate(c, s, local); }
};

/// Distance from `localA` to `localB` along `n`, where the bodies are.   [m]
template <class T>
T distanceAlong(BasicVec2<T> n, const BasicPose<T>& a, BasicVec2<T> localA, const BasicPose<T>& b,
                BasicVec2<T> localB)
{
    return dot(n, b.at(localB) - a.at(localA));
}

/// A point of contact at given poses: where it is, and how far apart the surfaces are.
template <class T>
struct BasicPlacedPoint {
    BasicVec2<T> armA, armB;   ///< from each center of mass   [m]
    T gap = T(real(0));        ///< beyond the rest gap        [m]
};
using PlacedPoint = BasicPlacedPoint<real>;

/// The point of contact of two surface points, each seen from the center of its body, for centers `d` = B - A
/// apart. It goes with the corner, on its surface: the other surface slides past it, and a disc rolls on its
/// own radius.
template <class T>
BasicPlacedPoint<T> placedPoint(BasicVec2<T> n, BasicVec2<T> surfaceA, BasicVec2<T> surfaceB, BasicVec2<T> d,
                                MaskOf<T> cornerOnA, T restGap)
{
    return {select(cornerOnA, surfaceA, surfaceB + d), select(cornerOnA, surfaceA - d, surfaceB),
            dot(n, d + surfaceB - surfaceA) - restGap};
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
