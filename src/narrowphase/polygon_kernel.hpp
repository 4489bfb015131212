// SPDX-License-Identifier: MIT
// How sharp polygons of up to N corners, or one and a line, meet that a face keeps apart, several pairs at
// once (T = Lane): what collideSwept says of such a pair, to the last bit. Of pairs that are another case
// (turning far, overlapping, sliding off) it says that it cannot decide. Derivation: docs/theory/contacts.md,
// section 2.
#pragma once

#include "narrowphase/face_kernel.hpp"

#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A polygon on its way through a span of time. Beyond its corners stand copies of the last one, which never
/// beat the one they copy.
template <class T, int N>
struct PolygonOnWay {
    BasicVec2<T> vertices[N], normals[N];  ///< in the body's frame, as those of Convex
    T last;  ///< the number of the last corner: a whole number
    BasicPose<T> start, end;
    T turn;  ///< by how much it turns in between, absolute   [rad]
    T extent;  ///< [m]
};

template <class T, int N>
struct PlacedPolygon {
    BasicVec2<T> vertices[N], normals[N];

    PlacedPolygon() = default;
    PlacedPolygon(const PolygonOnWay<T, N>& polygon, const BasicPose<T>& pose)
    {
        for (int i = 0; i < N; ++i) {
            vertices[i] = pose.at(polygon.vertices[i]);
            normals[i] = rotate(pose.c, pose.s, polygon.normals[i]);
        }
    }
};

template <class T>
struct PolygonPoint {
    BasicVec2<T> localA, localB;
    MaskOf<T> cornerOnA;
    T feature;  // a whole number
    BasicPlacedPoint<T> place;  // at the start
};

/// As SweptResult, of pairs that are decided.
template <class T>
struct PolygonResult {
    MaskOf<T> decided, near, bends, single;
    T startGap;
    BasicVec2<T> axis;  // and the gap along it: Apart
    T apart;
    BasicVec2<T> normal;
    PolygonPoint<T> points[2];
};

// One of N: `index` is a whole number from 0 on.
template <class T, int N>
struct Pick {
    MaskOf<T> over[N - 1];  // is the index greater than that?
    MaskOf<T> isLast;

    Pick(T index, T last) : isLast(index > last - T(real(0.5)))
    {
        for (int i = 0; i < N - 1; ++i) over[i] = index > T(static_cast<real>(i) + real(0.5));
    }

    BasicVec2<T> of(const BasicVec2<T> (&v)[N]) const
    {
        BasicVec2<T> picked = v[0];
        for (int i = 0; i < N - 1; ++i) picked = select(over[i], v[i + 1], picked);
        return picked;
    }
    BasicVec2<T> nextOf(const BasicVec2<T> (&v)[N]) const
    {
        BasicVec2<T> picked = v[1];
        for (int i = 0; i < N - 2; ++i) picked = select(over[i], v[i + 2], picked);
        return select(isLast, v[0], picked);
    }
};

/// By face of `core`, the least distance of the vertices of `other` in front of it; returns the greatest.
template <class T, int N>
T distancesByFace(const PlacedPolygon<T, N>& core, const PlacedPolygon<T, N>& other, T greatest,
                  T (&distances)[N])
{
    for (int i = 0; i < N; ++i) {
        T least(std::numeric_limits<real>::max());
        for (int k = 0; k < N; ++k)
            least = minimum(least, dot(core.normals[i], other.vertices[k] - core.vertices[i]));
        distances[i] = least;
        greatest = maximum(least, greatest);
    }
    return greatest;
}

template <class T>
BasicPose<T> select(MaskOf<T> condition, const BasicPose<T>& a, const BasicPose<T>& b)
{
    return {select(condition, a.p, b.p), select(condition, a.c, b.c), select(condition, a.s, b.s)};
}

/// The face of the best score over the sweep, as bestFaceOverSweep.
template <class T>
struct SweptPolygonFace {
    T score{-std::numeric_limits<real>::max()}, first, last, index;
    MaskOf<T> onB{};

    T least() const { return minimum(first, last); }
    void consider(MaskOf<T> better, bool ofB, int face, T itsScore, T atStart, T atEnd)
    {
        score = select(better, itsScore, score);
        first = select(better, atStart, first);
        last = select(better, atEnd, last);
        index = select(better, T(static_cast<real>(face)), index);
        if (ofB) onB = onB | better;
    }
};

/// That face in the frame of its body, and the polygon it faces in that of the other.
template <class T, int N>
struct FaceOfPolygons {
    MaskOf<T> onB;
    BasicVec2<T> normal, origin, next;
    BasicVec2<T> vertices[N], normals[N];
    T last;

    FaceOfPolygons(const PolygonOnWay<T, N>& a, const PolygonOnWay<T, N>& b, MaskOf<T> isOnB, T index)
        : onB(isOnB), last(select(isOnB, a.last, b.last))
    {
        const Pick<T, N> face(index, select(onB, b.last, a.last));
        normal = select(onB, face.of(b.normals), face.of(a.normals));
        origin = select(onB, face.of(b.vertices), face.of(a.vertices));
        next = select(onB, face.nextOf(b.vertices), face.nextOf(a.vertices));
        for (int i = 0; i < N; ++i) {
            vertices[i] = select(onB, a.vertices[i], b.vertices[i]);
            normals[i] = select(onB, a.normals[i], b.normals[i]);
        }
    }
};

/// The face at one end of the sweep, with the edge that faces it most squarely.
template <class T, int N>
struct ClippedPolygons {
    BasicVec2<T> n, origin;  // of the face
    T start, end;  // vertices of the edge: whole numbers
    ClippedEdge<T> clip;

    ClippedPolygons(const FaceOfPolygons<T, N>& face, const PolygonOnWay<T, N>& a,
                    const PolygonOnWay<T, N>& b, MaskOf<T> atEnd)
    {
        const BasicPose<T> poseA = select(atEnd, a.end, a.start), poseB = select(atEnd, b.end, b.start);
        const BasicPose<T> here = select(face.onB, poseB, poseA), there = select(face.onB, poseA, poseB);
        n = rotate(here.c, here.s, face.normal);
        origin = here.at(face.origin);
        start = T(real(0));
        T squarest = dot(n, rotate(there.c, there.s, face.normals[0]));
        for (int i = 1; i < N; ++i) {
            const T along = dot(n, rotate(there.c, there.s, face.normals[i]));
            const MaskOf<T> better = along < squarest;
            squarest = select(better, along, squarest);
            start = select(better, T(static_cast<real>(i)), start);
        }
        const Pick<T, N> edge(start, face.last);
        end = select(edge.isLast, T(real(0)), start + T(real(1)));
        clip = clipEdge(n, origin, here.at(face.next), there.at(edge.of(face.vertices)),
                        there.at(edge.nextOf(face.vertices)));
    }
};

/// The face that separates best at both ends: Apart.
template <class T>
struct PolygonAxis {
    T widest{-std::numeric_limits<real>::max()}, gap = widest;
    BasicVec2<T> axis;

    void consider(T first, T last, BasicVec2<T> normal)
    {
        const T narrower = minimum(first, last);
        const MaskOf<T> better = narrower > widest;
        widest = select(better, narrower, widest);
        gap = select(better, first, gap);
        axis = select(better, normal, axis);
    }
};

template <class T, int N>
void collidePolygons(const PolygonOnWay<T, N>& a, const PolygonOnWay<T, N>& b, T restGap,
                     PolygonResult<T>& result)
{
    const T lowest(-std::numeric_limits<real>::max());
    const T admit = T(real(3)) * restGap, deep = -restGap / T(real(2)), preference = T(real(0.1)) * restGap;
    const PlacedPolygon<T, N> a0(a, a.start), b0(b, b.start), a1(a, a.end), b1(b, b.end);
    T fromA0[N], fromB0[N], fromA1[N], fromB1[N];
    const T startGap = distancesByFace(b0, a0, distancesByFace(a0, b0, lowest, fromA0), fromB0);
    const T endGap = distancesByFace(b1, a1, distancesByFace(a1, b1, lowest, fromA1), fromB1);

    PolygonAxis<T> between;
    for (int i = 0; i < N; ++i) between.consider(fromA0[i], fromA1[i], a0.normals[i]);
    for (int i = 0; i < N; ++i) between.consider(fromB0[i], fromB1[i], -b0.normals[i]);
    result.axis = between.axis;
    result.apart = between.gap;

    // Could they come near at all? A gap can change no faster than the two move.
    const BasicVec2<T> slide = (b.end.p - a.end.p) - (b.start.p - a.start.p);
    const T travel = squareRoot(dot(slide, slide)) + a.turn * a.extent + b.turn * b.extent;
    const MaskOf<T> close = admit >= (startGap + endGap - travel) / T(real(2));
    result.startGap = startGap;
    result.decided = !close;
    result.near = result.bends = MaskOf<T>{};
    if (!any(close)) return;

    // The face that keeps them apart all the way.
    const T eighth(real(8));
    const T sagitta = a.turn * a.turn / eighth * a.extent + b.turn * b.turn / eighth * b.extent;
    SweptPolygonFace<T> best;
    for (int i = 0; i < N; ++i) {
        const T nearest = minimum(fromA0[i], fromA1[i]);
        const T score = faceScore(nearest, a0.normals[i], slide, deep, restGap);
        best.consider(score > best.score, false, i, score, fromA0[i], fromA1[i]);
    }
    for (int i = 0; i < N; ++i) {
        const T nearest = minimum(fromB0[i], fromB1[i]);
        const T score = faceScore(nearest, b0.normals[i], slide, deep, restGap);
        const T handicap = select(best.onB, T(real(0)), preference);
        best.consider(score > best.score + handicap, true, i, score, fromB0[i], fromB1[i]);
    }
    const MaskOf<T> turning = sagitta > restGap / T(real(2));
    const MaskOf<T> plain = (best.least() > deep) & (!turning);
    const MaskOf<T> admitted = close & plain & (!(best.least() > admit));
    result.decided = result.decided | (close & plain & (best.least() > admit));

    // Those that overlap at the start, or nearly and no worse later, or press on each other take it by force.
    const MaskOf<T> grazing = (startGap < restGap) & (best.least() > T(real(8)) * deep) & (!turning);
    const MaskOf<T> overlaps = (startGap < deep) | grazing;
    const MaskOf<T> presses = (admit >= startGap) & (travel < T(kSlowest) * restGap) & (!turning);
    const MaskOf<T> overlapping = close & (!plain) & (overlaps | presses);
    const MaskOf<T> through = best.first < startGap - T(kThrough) * restGap;
    const MaskOf<T> forced = overlapping & (!(sagitta >= restGap)) & (!through);
    if (!any(admitted | forced)) return;

    // The manifold on it, at the end where the gap is smaller. Where the edge lies beyond the face at both
    // ends, there is none.
    const MaskOf<T> slow = overlaps & (travel < T(real(0.25)) * minimum(a.extent, b.extent));
    const MaskOf<T> atEnd = (best.first + preference >= best.last) & ((!forced) | slow);
    const FaceOfPolygons<T, N> face(a, b, best.onB, best.index);
    const ClippedPolygons<T, N> edge(face, a, b, atEnd);
    const ClippedEdge<T>& clip = edge.clip;
    if (const MaskOf<T> beyond = admitted & clip.beyond; any(beyond)) {
        const ClippedPolygons<T, N> other(face, a, b, !atEnd);
        result.decided = result.decided | (beyond & other.clip.beyond);
    }
    const BasicPose<T> poseA = select(atEnd, a.end, a.start), poseB = select(atEnd, b.end, b.start);
    result.normal = select(best.onB, -edge.n, edge.n);
    result.single = clip.single;
    const MaskOf<T> all = (!close) | close;
    const T faceFeature = select(best.onB, T(real(64)), T(real(0))) + T(real(128)) * best.index;
    for (int i = 0; i < 2; ++i) {
        const MaskOf<T> isNear = i == 0 ? clip.beyond & (!clip.before) : MaskOf<T>(all);
        const BasicVec2<T> corner = select(isNear, clip.near, clip.far);
        const MaskOf<T> cut = i == 0 ? clip.farCut : clip.nearCut;
        const MaskOf<T> isEnd = (isNear & (!clip.swapped)) | ((!isNear) & clip.swapped);
        const BasicVec2<T> foot = footOn(edge.n, edge.origin, corner);
        PolygonPoint<T>& point = result.points[i];
        point.localA = inverseRotate(poseA.c, poseA.s, select(best.onB, corner, foot) - poseA.p);
        point.localB = inverseRotate(poseB.c, poseB.s, select(best.onB, foot, corner) - poseB.p);
        point.cornerOnA = (cut & (!best.onB)) | ((!cut) & best.onB);
        point.feature =
            select(cut, T(static_cast<real>(i == 0 ? 16 : 32)), select(isEnd, edge.end, edge.start)) +
            faceFeature;
    }

    for (PolygonPoint<T>& p : result.points) {
        const BasicVec2<T> none = T(real(0)) * result.normal;  // of rounding; makes 0 of -0
        p.place = placedPoint(result.normal, rotate(a.start.c, a.start.s, p.localA) + none,
                              rotate(b.start.c, b.start.s, p.localB) - none, b.start.p - a.start.p,
                              p.cornerOnA, restGap);
    }

    // Does the true surface leave its plane? Where that must be looked at halfway, it is left to others.
    const auto hides = [&](T gap, const BasicPose<T>& whereA, const BasicPose<T>& whereB) {
        const auto shown = [&](const PolygonPoint<T>& p) {
            return distanceAlong(result.normal, whereA, p.localA, whereB, p.localB);
        };
        const T first = minimum(T(std::numeric_limits<real>::max()), shown(result.points[0]));
        const T least = select(clip.single, first, minimum(first, shown(result.points[1])));
        return (gap < admit) & (least > gap - deep);
    };
    const MaskOf<T> hidden = hides(startGap, a.start, b.start) | hides(endGap, a.end, b.end);
    const T along = absolute(cross(result.normal, slide));
    const MaskOf<T> straight = -deep >= along * (a.turn + b.turn) / T(real(4));
    const MaskOf<T> met = (admitted & (!clip.beyond)) | forced;
    result.near = met & (turning | hidden | straight);
    result.bends = met & (turning | hidden);
    result.decided = result.decided | result.near;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
