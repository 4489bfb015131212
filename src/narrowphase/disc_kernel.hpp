// SPDX-License-Identifier: MIT
// How discs meet that are nearest at the start or at the end of a span, several pairs at once (T = Lane):
// what collideSwept says of such a pair, to the last bit. Derivation: docs/theory/contacts.md, section 2,
// convexity.
#pragma once

#include "narrowphase/face_kernel.hpp"

namespace tamias2d::inline TAMIAS_PRECISION {

/// Two discs on their ways through a span of time.
template <class T>
struct DiscsOnWay {
    BasicVec2<T> fromAToB[2];   ///< between the centers, at the start and at the end   [m]
    T radii;                    ///< both   [m]
    T turnTravelA, turnTravelB; ///< how far a point of the rim moves by turning   [m]
    T restGap;                  ///< [m]
};

/// As SweptResult, of pairs that are decided.
template <class T>
struct DiscResult {
    MaskOf<T> decided, near, bends;
    T startGap;
    BasicVec2<T> axis;   // along which that is the gap
    BasicVec2<T> normal;
};

/// From one center to the other.
template <class T>
struct CenterLine {
    T distance;             // [m]
    BasicVec2<T> normal;    // any where there is no distance

    explicit CenterLine(BasicVec2<T> d)
        : distance(squareRoot(dot(d, d))), normal(select(distance > T(real(0)), (T(real(1)) / distance) * d,
                                                         BasicVec2<T>{T(real(0)), T(real(1))}))
    {
    }
};

template <class T>
DiscResult<T> collideDiscs(const DiscsOnWay<T>& discs)
{
    const T zero(real(0)), two(real(2));
    const T admit = T(real(3)) * discs.restGap, deep = -discs.restGap / two;
    T gaps[2];
    BasicVec2<T> normals[2];
    for (int i = 0; i < 2; ++i) {
        const CenterLine<T> line(discs.fromAToB[i]);
        normals[i] = line.normal;
        gaps[i] = line.distance - discs.radii;
    }
    const BasicVec2<T> slide = discs.fromAToB[1] - discs.fromAToB[0];
    const T travel = squareRoot(dot(slide, slide)) + discs.turnTravelA + discs.turnTravelB;
    const MaskOf<T> close = admit >= (gaps[0] + gaps[1] - travel) / two;

    // The gap is a convex function of time: least at an end, unless approach turns to departure in between.
    const MaskOf<T> overlap = gaps[0] < deep;
    const MaskOf<T> lessAtEnd = (gaps[1] < gaps[0]) & (gaps[1] > T(real(8)) * deep);
    const MaskOf<T> apartAtEnd = gaps[1] > deep;
    const MaskOf<T> parting = apartAtEnd & (dot(normals[0], slide) >= zero);
    const MaskOf<T> nearing = apartAtEnd & (!parting) & (zero >= dot(normals[1], slide));
    const MaskOf<T> pressing =
        (!overlap) & (!parting) & (!nearing) & (admit >= gaps[0]) & (travel < T(kSlowest) * discs.restGap);
    const MaskOf<T> atEnd = (overlap & lessAtEnd) | ((!overlap) & nearing);

    DiscResult<T> result;
    result.startGap = gaps[0];
    result.axis = normals[0];
    result.normal = select(atEnd, normals[1], normals[0]);
    result.decided = (!close) | overlap | pressing | parting | nearing;
    result.near =
        close & (overlap | pressing | ((parting | nearing) & (admit >= select(atEnd, gaps[1], gaps[0]))));
    const auto hides = [&](int i) {
        const T shown = dot(result.normal, discs.fromAToB[i]) - discs.radii;
        return (gaps[i] < admit) & (shown > gaps[i] - deep);
    };
    result.bends = result.near & (hides(0) | hides(1));
    return result;
}

}  // namespace tamias2d::inline TAMIAS_PRECISION
