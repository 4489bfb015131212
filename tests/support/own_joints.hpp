// SPDX-License-Identifier: MIT
#pragma once

#include "support/build.hpp"

#include <cmath>
#include <span>
#include <string_view>

// Constraints as a user of the library writes them.
namespace tamias2d::test {

using ConstraintBodies = std::span<const ConstraintBody>;

/// Two points at a distance: what a DistanceJoint is.
struct OwnRod {
    static constexpr int bodies = 2;
    static constexpr std::string_view name = "OwnRod";
    Vec2 onA = {}, onB = {};
    double length = 1;
    bool isRope = false;

    void measure(ConstraintBodies at, ConstraintRows& rows) const
    {
        const DVec2 between = at[1].point(onB) - at[0].point(onA);
        const double distance = tamias2d::length(between);
        const Vec2 n = distance > 0 ? toVec2((1 / distance) * between) : Vec2{1, 0};
        if (isRope)
            rows.limit(length - distance).moveAt(0, n, at[0].arm(onA)).moveAt(1, -n, at[1].arm(onB)).bears();
        else
            rows.rigid(distance - length).moveAt(0, -n, at[0].arm(onA)).moveAt(1, n, at[1].arm(onB));
        rows.position(distance).moveAt(0, -n, at[0].arm(onA)).moveAt(1, n, at[1].arm(onB));
    }
};

/// Two points stay together: what a RevoluteJoint is.
struct OwnHinge {
    static constexpr int bodies = 2;
    Vec2 onA = {}, onB = {};

    void measure(ConstraintBodies at, ConstraintRows& rows) const
    {
        const DVec2 between = at[1].point(onB) - at[0].point(onA);
        for (const Vec2 n : {Vec2{1, 0}, Vec2{0, 1}})
            rows.rigid(dot(toDVec2(n), between)).moveAt(0, -n, at[0].arm(onA)).moveAt(1, n, at[1].arm(onB));
    }
};

/// A bead on a wire: y = x^2/2.
struct OnParabola {
    static constexpr int bodies = 1;
    static constexpr std::string_view name = "OnParabola";

    void measure(ConstraintBodies at, ConstraintRows& rows) const
    {
        const Position p = at[0].center;
        rows.rigid(p.y - p.x * p.x / 2).move(0, vec(-p.x, 1));
        rows.position(p.x).move(0, {1, 0});
    }
};

/// A differential: a * angle 0 + b * angle 1 + c * angle 2 stays what it is.
struct Differential {
    static constexpr int bodies = 3;
    static constexpr std::string_view name = "Differential";
    double a = 1, b = 1, c = -2;

    void measure(ConstraintBodies at, ConstraintRows& rows) const
    {
        rows.rigid(a * at[0].turned + b * at[1].turned + c * at[2].turned)
            .turn(0, toReal(a))
            .turn(1, toReal(b))
            .turn(2, toReal(c));
    }
};

/// The second body stays midway between the two others.
struct Midway {
    static constexpr int bodies = 3;

    void measure(ConstraintBodies at, ConstraintRows& rows) const
    {
        const DVec2 off = 0.5 * (at[0].center - at[1].center) + 0.5 * (at[2].center - at[1].center);
        const Vec2 half = vec(0.5, 0);
        rows.rigid(off.x).move(0, half).move(1, {-1, 0}).move(2, half);
        rows.rigid(off.y).move(0, perpendicular(half)).move(1, {0, -1}).move(2, perpendicular(half));
    }
};

/// The mean height of all is kept.
template <int Count>
struct MeanHeight {
    static constexpr int bodies = Count;
    double height = 0;

    void measure(ConstraintBodies at, ConstraintRows& rows) const
    {
        double mean = 0;
        for (const ConstraintBody& body : at) mean += body.center.y / Count;
        auto row = rows.rigid(mean - height);
        for (int i = 0; i < Count; ++i) row.move(i, vec(0, 1.0 / Count));
    }
};

/// Drives a body upwards.
struct Lift {
    static constexpr int bodies = 1;
    real speed = 1, maxForce = 100;

    void measure(ConstraintBodies, ConstraintRows& rows) const
    {
        rows.motor(speed, maxForce).move(0, {0, 1});
    }
};

/// Says whatever it is told to.
template <int Count, class Says>
struct Saying {
    static constexpr int bodies = Count;
    static constexpr std::string_view name = "Saying";
    Says says;

    void measure(ConstraintBodies at, ConstraintRows& rows) const { says(at, rows); }
};
template <int Count, class Says>
Saying<Count, Says> saying(Says says)
{
    return {says};
}

}  // namespace tamias2d::test
