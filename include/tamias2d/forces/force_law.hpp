// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/ids.hpp>
#include <tamias2d/math/transform.hpp>

#include <functional>
#include <string>

namespace tamias2d::inline TAMIAS_PRECISION {

/// What a force law may look at.
struct BodyView {
    BodyId id = {};
    Position center = {};   ///< of mass              [m]
    double angle = 0;       ///< in [0, 2 pi)         [rad]
    DVec2 velocity = {};    ///< of the center        [m/s]
    double spin = 0;        ///< angular velocity     [rad/s]
    double mass = 0;        ///< [kg]
    double inertia = 0;     ///< [kg*m^2]
};

/// A force at the center of mass and a torque.
struct Wrench {
    DVec2 force = {};   ///< [N]
    double torque = 0;  ///< [N*m]
};

/// A force that depends on where the body is, how it moves and on time. It is evaluated twice in every tick
/// (half a sub-step), so that a spring keeps its energy: a force held over a whole step pumps it up.
struct ForceLaw {
    std::string name = {};  ///< for scene files, which write a law of your own by its name only
    /// The force at time `t` [s]. Must not touch the World. A throw or a value that is not finite as `real`
    /// counts as no force and shows in StepReport::forceLawFaults.
    std::function<Wrench(const BodyView& body, double t)> force = {};
    /// The potential energy [J], if there is one: energy() then includes it. A throw or a non-finite value
    /// counts as 0.
    std::function<double(const BodyView& body, double t)> potential = {};
    std::string parameters = {};  ///< of a built-in law, as JSON text, so that scenes can write it
};

using ForceLawId = Id<struct ForceLawTag>;

/// A spring and damper from the center of mass to a fixed point: F = -k (x - p) - c v.
/// stiffness [N/m] >= 0, damping [N*s/m] >= 0
ForceLaw springTo(Position point, double stiffness, double damping = 0);

/// Attraction by a fixed point as by a mass: F = -mu m d / |d|^3, with mu = G M [m^3/s^2]. Inside
/// `softening` [m] >= 0 of the point the pull fades, so that it stays finite (Plummer).
ForceLaw attractionTo(Position point, double mu, double softening = 0);

/// Drag of a fluid: F = -linear v - quadratic |v| v.   [N*s/m] >= 0, [N*s^2/m^2] >= 0
ForceLaw drag(double linear, double quadratic = 0);

/// A torsion spring towards an angle: torque = -k (phi - phi0) - c omega, the short way round.
/// stiffness [N*m/rad] >= 0, damping [N*m*s/rad] >= 0
ForceLaw torsionSpring(double angle, double stiffness, double damping = 0);

}  // namespace tamias2d::inline TAMIAS_PRECISION
