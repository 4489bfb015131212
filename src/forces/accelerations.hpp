// SPDX-License-Identifier: MIT
#pragma once

#include "model/bodies.hpp"
#include "model/motion.hpp"

#include <tamias2d/forces/force_law.hpp>

#include <utility>
#include <vector>

namespace tamias2d::inline TAMIAS_PRECISION {

/// A law and the body it acts on (a null id: every dynamic body).
struct PlacedLaw {
    ForceLawId id;
    BodyId body;
    ForceLaw law;
};

/// All that pushes bodies from outside.
struct ForceField {
    Vec2 gravity;                        // [m/s^2]
    double gravitationConstant = 0;      // [m^3/(kg*s^2)]
    const std::vector<PlacedLaw>& laws;
    double most = 1e300;                 // what an acceleration is held at, along each axis   [m/s^2]
    double mostSpinRate = 1e300;         // [rad/s^2]

    /// Does the acceleration of some body of the step change within it?
    bool varies(const MotionTable& motions, const BodyTable& bodies) const;
    /// Does that of this one?
    bool variesFor(const Motion& motion, const BodyTable& bodies) const;
};

/// Sets acceleration and spinRate of every row from gravity, forces, gravitation and laws, for the
/// state it has now. Returns how many laws threw or gave no number.
std::uint32_t accelerate(MotionTable& motions, const BodyTable& bodies, const ForceField& field, double time);

/// The same for one row of a body that has just come in; without gravitation, under which none sleeps.
std::uint32_t accelerateOne(Motion& motion, const BodyTable& bodies, const ForceField& field, double time);

/// What the laws do to a body as it is; counts the faulty ones.
Wrench wrenchOfLaws(const BodyRow& body, BodyId id, const ForceField& field, double time,
                    std::uint32_t& faults);

/// Potential energy of gravity and laws on one body, and of the gravitation of all pairs.   [J]
double potentialEnergy(const BodyTable& bodies, std::uint32_t slot, const ForceField& field, double time);
double gravitationEnergy(const BodyTable& bodies, double gravitationConstant);

}  // namespace tamias2d::inline TAMIAS_PRECISION
