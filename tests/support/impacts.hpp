// SPDX-License-Identifier: MIT
#pragma once

#include <support/run.hpp>
#include <tamias2d/tamias2d.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

// The impact law DD8, worked out in double from what HitEvents report, beside what they claim.
namespace tamias2d::test {

/// How a body moves and resists; a static or kinematic one has no inverses.
struct Mover {
    DVec2 velocity;            ///< [m/s]
    double spin = 0;           ///< [rad/s]
    double inverseMass = 0;    ///< [1/kg]
    double inverseInertia = 0; ///< [1/(kg*m^2)]
};
using Movers = std::map<BodyId, Mover>;

inline Movers moversOf(World& world)
{
    Movers movers;
    for (const BodyId id : world.bodies()) {
        const Body body = world.body(id);
        const double mass = static_cast<double>(body.mass()), inertia = static_cast<double>(body.inertia());
        const bool moved = body.type() == BodyType::Dynamic;
        movers[id] = {velocityOf(body), spinOf(body), moved ? 1 / mass : 0,
                      moved && inertia > 0 ? 1 / inertia : 0};
    }
    return movers;
}

inline void push(Mover& m, DVec2 impulse, DVec2 arm)
{
    m.velocity += m.inverseMass * impulse;
    m.spin += m.inverseInertia * cross(arm, impulse);
}

/// v_B - v_A at the point of a hit [m/s].
inline DVec2 slipAt(const HitEvent& hit, const Mover& a, const Mover& b)
{
    return b.velocity + cross(b.spin, toDVec2(hit.armB)) - a.velocity - cross(a.spin, toDVec2(hit.armA));
}

/// The change of n . (v_B - v_A) at hit p by an impulse 1 along `direction` at hit q [1/kg].
inline double mobility(const HitEvent& p, const HitEvent& q, DVec2 direction, const Mover& a, const Mover& b)
{
    const auto turn = [&](Vec2 arm) { return cross(toDVec2(arm), direction); };
    return a.inverseMass + b.inverseMass + a.inverseInertia * turn(p.armA) * turn(q.armA) +
           b.inverseInertia * turn(p.armB) * turn(q.armB);
}

/// The normal impulses that give v_n' = -C_R v_n at every point of one impact (one or two) [N*s].
inline std::vector<double> impulsesOf(const std::vector<HitEvent>& hits, const Mover& a, const Mover& b)
{
    const DVec2 n = toDVec2(hits[0].normal);
    const auto wanted = [&](const HitEvent& h) {
        return -(1 + static_cast<double>(h.restitution)) * dot(n, slipAt(h, a, b));
    };
    const double k11 = mobility(hits[0], hits[0], n, a, b);
    if (hits.size() == 1) return {wanted(hits[0]) / k11};
    const double k12 = mobility(hits[0], hits[1], n, a, b), k22 = mobility(hits[1], hits[1], n, a, b);
    const double b1 = wanted(hits[0]), b2 = wanted(hits[1]), det = k11 * k22 - k12 * k12;
    return {(k22 * b1 - k12 * b2) / det, (k11 * b2 - k12 * b1) / det};
}

/// How much larger than that of the speeds the error of one of two impulses may be: their sum is well
/// determined, but how it is shared is less so the closer the two points are.
inline double conditionOf(const std::vector<HitEvent>& hits, const Mover& a, const Mover& b)
{
    if (hits.size() == 1) return 1;
    const DVec2 n = toDVec2(hits[0].normal);
    const double k11 = mobility(hits[0], hits[0], n, a, b), k22 = mobility(hits[1], hits[1], n, a, b);
    const double k12 = mobility(hits[0], hits[1], n, a, b);
    return k11 * k22 / (k11 * k22 - k12 * k12);
}

/// The impacts of the last step in order; two hits at once on one pair are one impact.
inline std::vector<std::vector<HitEvent>> impactsOf(const World& world)
{
    std::vector<std::vector<HitEvent>> impacts;
    for (const HitEvent& hit : world.events().hits) {
        const bool joins = !impacts.empty() && impacts.back().back().group == hit.group &&
                           impacts.back().back().time == hit.time &&
                           impacts.back().back().shapeA == hit.shapeA &&
                           impacts.back().back().shapeB == hit.shapeB;
        if (!joins) impacts.emplace_back();
        impacts.back().push_back(hit);
    }
    return impacts;
}

/// Works the hits of the last step through DD8, one impact after the other, and compares each figure they
/// report. Leaves in `movers` what the formula says; `friction` is the coefficient of all pairs. An impact
/// starts from the velocities it reports; they must be those left by the one before, unless `free` is false.
inline void applyHits(const World& world, Movers& movers, double tolerance, double friction, bool free)
{
    const std::vector<std::vector<HitEvent>> impacts = impactsOf(world);
    for (const std::vector<HitEvent>& impact : impacts) {
        Mover &a = movers.at(impact[0].bodyA), &b = movers.at(impact[0].bodyB);
        Mover startA = a, startB = b;
        startA.velocity = toDVec2(impact[0].velocityA);
        startB.velocity = toDVec2(impact[0].velocityB);
        startA.spin = static_cast<double>(impact[0].angularVelocityA);
        startB.spin = static_cast<double>(impact[0].angularVelocityB);
        const DVec2 n = toDVec2(impact[0].normal), t = perpendicular(n);
        const double scale =
            length(startA.velocity) + length(startB.velocity) + std::abs(startA.spin) + std::abs(startB.spin);
        if (free || &impact == &impacts.front()) {
            EXPECT_LE(length(startA.velocity - a.velocity), tolerance * scale);
            EXPECT_LE(length(startB.velocity - b.velocity), tolerance * scale);
            EXPECT_NEAR(startA.spin, a.spin, tolerance * scale);
            EXPECT_NEAR(startB.spin, b.spin, tolerance * scale);
        }
        a = startA;
        b = startB;
        const std::vector<double> impulses = impulsesOf(impact, a, b);
        for (std::size_t i = 0; i < impact.size(); ++i) {
            const HitEvent& hit = impact[i];
            EXPECT_NEAR(length(toDVec2(hit.normal)), 1, tolerance);
            EXPECT_GT(hit.approachSpeed, 0);
            EXPECT_NEAR(static_cast<double>(hit.approachSpeed), -dot(n, slipAt(hit, a, b)),
                        tolerance * scale);
            // Relative to the impulse, or to what would stop the bodies altogether if they hardly meet.
            const double room =
                std::max(impulses[i], scale / mobility(hit, hit, n, a, b)) * conditionOf(impact, a, b);
            EXPECT_NEAR(static_cast<double>(hit.normalImpulse), impulses[i], tolerance * room);
        }
        for (std::size_t i = 0; i < impact.size(); ++i) {
            push(a, -impulses[i] * n, toDVec2(impact[i].armA));
            push(b, impulses[i] * n, toDVec2(impact[i].armB));
        }
        for (std::size_t i = 0; i < impact.size(); ++i) {
            const HitEvent& hit = impact[i];
            const double k = mobility(hit, hit, t, a, b), stop = -dot(t, slipAt(hit, a, b)) / k;
            const double tangent = std::clamp(stop, -friction * impulses[i], friction * impulses[i]);
            EXPECT_NEAR(static_cast<double>(hit.tangentImpulse), tangent, tolerance * scale / k);
            push(a, -tangent * t, toDVec2(hit.armA));
            push(b, tangent * t, toDVec2(hit.armB));
        }
    }
}

/// What contacts that last gave in the last step beside the impacts, all points together [N*s]. Contacts
/// that an impact has ended are not listed any more, and count as zero.
inline double pressingOf(const World& world)
{
    double total = 0;
    for (const ContactView& contact : world.contacts()) {
        for (int i = 0; i < contact.pointCount; ++i) {
            total += static_cast<double>(contact.points[static_cast<std::size_t>(i)].normalImpulse);
        }
    }
    for (const HitEvent& hit : world.events().hits) total -= static_cast<double>(hit.normalImpulse);
    return total;
}

/// Compares the velocities of all bodies with `expected`, within `tolerance` of `scale` [m/s].
inline void expectVelocities(World& world, const Movers& expected, double tolerance, double scale)
{
    for (const auto& [id, mover] : expected) {
        const Body body = world.body(id);
        EXPECT_LE(length(velocityOf(body) - mover.velocity), tolerance * scale)
            << "is " << velocityOf(body).x << ", " << velocityOf(body).y << " for " << mover.velocity.x
            << ", " << mover.velocity.y;
        EXPECT_LE(std::abs(spinOf(body) - mover.spin), tolerance * (scale + std::abs(mover.spin)))
            << "is " << spinOf(body) << " for " << mover.spin;
    }
}

}  // namespace tamias2d::test
