// SPDX-License-Identifier: MIT
#pragma once

#include "narrowphase/face_kernel.hpp"
#include "narrowphase/manifold.hpp"

#include <tamias2d/geometry/aabb.hpp>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Where a body goes within a step if nothing hits it: a parabola, with a quadratic angle.
/// Positions are relative to an origin shared by the pair.
struct Trajectory {
    Vec2 position;          ///< of the center of mass at time 0   [m]
    double angle = 0;       ///< at time 0                         [rad]
    Rot rotation;           ///< of that angle
    Vec2 velocity;          ///< [m/s]
    real spin = 0;          ///< [rad/s]
    Vec2 acceleration;      ///< [m/s^2]
    real spinRate = 0;      ///< angular acceleration              [rad/s^2]
    real aheadTime = 0;     ///< if > 0: a time at which the rotation is known ...   [s]
    Rot ahead;              ///< ... and is this

    /// Reckons that rotation once, for all that ask later.
    void lookAhead(real t);
    Pose at(real t) const;
    Vec2 positionAt(real t) const { return position + t * velocity + (t * t / 2) * acceleration; }
    real turnBy(real t) const { return t * spin + t * t / 2 * spinRate; }
};

/// Two shapes on their ways.
struct SweptPair {
    const Convex& a;
    const Convex& b;
    Trajectory pathA, pathB;
    real restGap;           ///< [m]
};

struct SweptResult {
    real startGap = 0;      ///< between the surfaces at the start, or less   [m]
    Apart apart;            ///< how the two are apart at the start
    bool near = false;      ///< there is a manifold
    bool exhausted = false; ///< the search for the time of impact ran out of iterations: taken as a hit
    bool bends = false;  ///< the true way bends off the manifold's normal by more than counts as overlap
    Manifold manifold;
    bool placed = false;    ///< are its points placed where the two are at the start? By lanes they are
    PlacedPoint places[2];
};

/// How the pair meets between the times `from` and `to`: a manifold that keeps the two apart all
/// the way if there is one (support), else the manifold of the moment they meet (impact).
/// docs/theory/contacts.md, section 2.
SweptResult collideSwept(const SweptPair& pair, real from, real to);

/// The manifold of the closest features at one time on the way, if they are near enough for one.
SweptResult nearestAt(const SweptPair& pair, real t);

/// A box that holds the shape all the way between two times, seen from `origin`, grown by `margin`.
Aabb sweptBounds(const Convex& shape, const Trajectory& path, Position origin, real from, real to,
                 real margin);

/// Gap between the surfaces at a time on the way; < 0 is overlap.   [m]
real gapAt(const SweptPair& pair, real t);

}  // namespace tamias2d::inline TAMIAS_PRECISION
