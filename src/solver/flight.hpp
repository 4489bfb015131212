// SPDX-License-Identifier: MIT
#pragma once

#include "contacts/rows.hpp"
#include "narrowphase/swept.hpp"

#include <limits>

namespace tamias2d::inline TAMIAS_PRECISION {

constexpr real kNever = std::numeric_limits<real>::max();

/// A body on its way through a tick. Its place is that of the tick's start plus
/// offset + velocity t + acceleration t^2/2: an impact at t shifts the offset by -t dv.
struct Flight {
    Vec2 offset;          ///< [m]
    real turned = 0;      ///< [rad]
    Vec2 velocity;        ///< [m/s]
    real spin = 0;        ///< [rad/s]
    Vec2 acceleration;    ///< [m/s^2]
    real spinRate = 0;    ///< [rad/s^2]
    real clock = 0;       ///< time of its last impact within the tick   [s]
    real extent = 0;      ///< farthest point of its shapes from the center   [m]
    real strayed = 0;  ///< by the end of the tick no point of it is farther from where it was to be   [m]

    Vec2 shiftAt(real t) const { return offset + t * velocity + (t * t / 2) * acceleration; }
    real turnAt(real t) const { return turned + t * spin + t * t / 2 * spinRate; }
};

Flight flightOf(const Motion& m, real invH);

/// The way of a flying body, seen from `origin`.
Trajectory pathOf(const Motion& m, const Flight& flight, Position origin, real invH);

/// The two bodies of a contact on their ways.
struct FlyingPair {
    const Motion &a, &b;
    const Flight &flightA, &flightB;

    real start() const { return maximum(flightA.clock, flightB.clock); }
};

/// Two bodies and a point between them at one moment.
struct Moment {
    Vec2 normal;
    PlacedPoint place;
    Vec2 velocityA, velocityB;
    real spinA = 0, spinB = 0;

    Vec2 relative() const
    {
        return velocityB + cross(spinB, place.armB) - velocityA - cross(spinA, place.armA);
    }
    real normalSpeed() const { return dot(normal, relative()); }
};

/// Bodies and point at time `t` of the tick, turned as they are then.
Moment momentAt(const Contact& contact, const ManifoldPoint& anchor, const FlyingPair& pair, real t);

/// What the search for impacts needs to know of a point. The gap is taken back to the start of the tick.
struct ImpactPoint {
    Vec2 normal;
    real turnA = 0, turnB = 0;  ///< arm x normal   [m]
    real gap = 0;  ///< beyond the rest gap   [m]
    bool yields = false;  ///< does an impulse at it move anything?
};

/// How the gap of a point changes on the ways of two bodies.
struct Closing {
    real speed;    ///< at the start of the tick   [m/s]
    real push;     ///< how that changes   [m/s^2]
    real offset;   ///< what impacts have put the gap off by, seen from there   [m]

    Closing(const ImpactPoint& p, const Flight& a, const Flight& b)
        : speed(dot(p.normal, b.velocity - a.velocity) + p.turnB * b.spin - p.turnA * a.spin),
          push(dot(p.normal, b.acceleration - a.acceleration) + p.turnB * b.spinRate - p.turnA * a.spinRate),
          offset(dot(p.normal, b.offset - a.offset) + p.turnB * b.turned - p.turnA * a.turned)
    {
    }
    real at(real t) const { return speed + push * t; }
};

/// After what time a gap [m] that changes at `rate` [m/s], which changes by `bend` [m/s^2], first closes;
/// kNever if it does not. docs/theory/contacts.md, eq. 9.
real closingTime(real gap, real rate, real bend);

/// Is a prepared point of the contact all that the search asks for? The manifold of an impact is linearized
/// about its own pose instead: a fast spinner has turned far from the start of the tick by then.
bool isPlainPoint(const Contact& contact, int point);

/// A point for the search, of a contact that is prepared.
ImpactPoint impactPoint(const Contact& contact, int point, const FlyingPair& pair);
/// The same of a point that is not plain, of a contact that need not be; `yields` is left out.
ImpactPoint turnedImpactPoint(const Contact& contact, int point, const FlyingPair& pair);

/// A point of a contact and when it is hit.
struct Impact {
    real time = kNever;  ///< within the tick   [s]
    int point = 0;
};

/// How two bodies are apart at `start`, on their ways, if it was `apart` at the start of the tick; at least.
Apart apartAt(real start, const Apart& apart, const Flight& a, const Flight& b);
/// The reverse: how they were apart at the start of the tick if it is `apart` at `start`; at least.
Apart apartBefore(real start, const Apart& apart, const Flight& a, const Flight& b);
/// A bound on how far any two points of two bodies near each other along `axis` between two times.   [m]
real approachWithin(Vec2 axis, const Flight& a, const Flight& b, real from, real to);

/// The first impact of a contact in the rest of the tick: when a gap first closes faster than steady
/// forces could make it. Time kNever if there is none.
Impact nextImpact(const Contact& contact, const ImpactPoint points[2], const FlyingPair& pair,
                  const StepContext& context);

}  // namespace tamias2d::inline TAMIAS_PRECISION
