// SPDX-License-Identifier: MIT
#pragma once

#include "base/pages.hpp"
#include "narrowphase/manifold.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// Contacts that are worth a thread's while, where little is done with each.
inline constexpr std::size_t kContactGrain = 256;

/// One point of a contact: where it is, what it carries, and what the solver prepared.
struct ContactPointRow {
    ManifoldPoint anchor;

    // Carried from tick to tick and from step to step.
    real normalImpulse = 0;      // of the last tick     [N*s]   >= 0
    real tangentImpulse = 0;     // along the normal turned by +90 degrees
    bool wasLoaded = false;      // at the start of the tick

    // Summed over the step, impacts included.
    real stepNormal = 0, stepTangent = 0;   // [N*s]

    // Prepared at the poses at hand.
    Vec2 armA, armB;             // from the centers of mass to the point of contact   [m]
    real gap = 0;                // beyond the rest gap   [m]
    real normalMass = 0, tangentMass = 0;   // inverse of the effective masses   [1/kg]
};

/// Two shapes whose swept boxes overlap, and all that is known of how they meet.
///
/// Invariants: shapeA < shapeB (slots); 0 <= count <= 2; |normal| = 1 if count > 0.
struct Contact {
    std::uint32_t shapeA = 0, shapeB = 0;   // slots
    std::uint32_t rowA = 0, rowB = 0;       // rows of their bodies in the MotionTable
    Vec2 normal;                 // from A to B
    int count = 0;
    ContactPointRow points[2];
    real radiusA = 0, radiusB = 0;   // of rounding   [m]
    real restGap = 0;            // [m]
    real friction = 0, restitution = 0;
    real rolling = 0;            // rolling resistance x rounding radius   [m]
    real rollingImpulse = 0;     // [N*m*s]
    real surfaceSpeed = 0;       // of B's surface against A's along the tangent   [m/s]
    Vec2 stepImpulse;            // on B, summed over the step, whatever became of the points   [N*s]
    real pushed = 0;             // impulses of the pass that undoes overlaps   [N*s]
    real time = 0;               // of the pose of the manifold, within the tick   [s]
    bool swept = false;          // looked at again in every tick
    Apart apart;                 // of a swept pair: so it is apart now, or more
    bool atImpact = false;       // the manifold is that of a moment of impact
    std::uint32_t versionA = 0, versionB = 0;   // of the angles of its bodies that the manifold is for,
    DVec2 between;               // and from center to center then, from A to B   [m]
    bool touching = false;       // at the end of the last step
    bool crowded = false;        // between bodies of at least Tuning::crowd that meet
    std::int8_t stiffSteps =
        0;  // its pile is solved at once for so long; < 0: is not. solver/stiff_piles.hpp
    int impacts = 0;             // in this tick
    real fastestImpact = 0;      // approach of the fastest of them   [m/s]
};

/// How near the shapes of a contact are: with no points, with some, or touching or under load.
enum class Nearness : std::uint8_t { Apart, Near, Linked };

/// What a step asks of every contact, side by side: where nothing changes, the table of all else stays
/// closed.
struct ContactFacts {
    std::uint32_t rowA, rowB;
    std::uint32_t versionA, versionB;
    DVec2 between;
    real room;  // how far its bodies may move against each other before its manifold is another   [m]
    bool swept;
};

/// What a contact carries in a tick, on B; A bears the opposite. T is real, or a Lane.
template <class T>
struct BasicContactLoad {
    BasicVec2<T> impulse;       // [N*s]
    T momentA{}, momentB{};     // about the centers   [N*m*s]
};
using ContactLoad = BasicContactLoad<real>;
static_assert(sizeof(ContactLoad) == 4 * sizeof(real), "lanes write them as groups of four");

/// All contacts, sorted by (shapeA, shapeB); those found in mid-step stand at the end until the next. What
/// the lanes of the solver hold from step to step may be newer than the rows: ContactPasses::tell.
struct ContactTable {
    Table<Contact> rows;
    Table<ContactFacts> facts;  // of the rows, one by one, from the manifolds of a step to the next
    std::vector<Nearness> nearness;  // likewise
    Table<ContactLoad> loads;  // of the first rows, from the end of a step to the next; none if these change
    std::vector<std::uint32_t> order;  // in which they are solved: by color, then by row
    std::vector<std::uint32_t> colorEnds;  // where each color ends in it; the last one is solved in order
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
