// SPDX-License-Identifier: MIT
#pragma once

#include <tamias2d/base/ids.hpp>
#include <tamias2d/base/lane_width.hpp>
#include <tamias2d/geometry/mass.hpp>
#include <tamias2d/geometry/shapes.hpp>
#include <tamias2d/math/transform.hpp>
#include <tamias2d/model/material.hpp>
#include <tamias2d/model/tuning.hpp>
#include <tamias2d/tasks/task_system.hpp>

#include <cstdint>
#include <memory_resource>
#include <optional>
#include <string>

namespace tamias2d::inline TAMIAS_PRECISION {

// Bounds of all inputs; those of lengths are times the world's lengthUnit.
inline constexpr double kMaxPosition = 1e9;  ///< [m]
inline constexpr double kMaxSpeed = 1e6;     ///< [m/s]
inline constexpr double kMaxSpin = 1e6;      ///< [rad/s]
inline constexpr double kMinSize = 1e-6;     ///< [m]
inline constexpr double kMaxSize = 1e6;      ///< [m]

/// What a new World is like.
struct WorldDef {
    Vec2 gravity = {0, real(-9.81)};  ///< [m/s^2]
    real gravitationConstant =
        0;     ///< G of T3; 0 switches it off. Nature's is 6.673e-11   [m^3/(kg*s^2)] >= 0
    real lengthUnit = 1;  ///< the length of a typical body; scales Tuning and the bounds   [m]   > 0
    MixingRule frictionMixing = MixingRule::GeometricMean;  ///< not MixingRule::World
    MixingRule restitutionMixing = MixingRule::Maximum;  ///< not MixingRule::World
    bool allowSleep = true;  ///< bodies at rest fall asleep: they cost nothing until something happens
    Tuning tuning = {};
    LaneWidth lanes = LaneWidth::Best;  ///< one that this machine has; no result depends on it
    /// That step() works with, the calling one included; the World starts and keeps the others, or as many as
    /// the system gives. No result depends on it.   1 to kMaxThreads; 1 in builds without threads
    int threads = 1;
    TaskSystem* tasks = nullptr;  ///< a host's own threads instead; it outlives the World
    /// What the tables of bodies and shapes take their memory from; new and delete if null. It outlives the
    /// World. No result depends on it.
    std::pmr::memory_resource* memory = nullptr;
};

/// Nature's constant of gravitation, as the SRS states it [T3].
inline constexpr double kGravitationConstant = 6.673e-11;  ///< [m^3/(kg*s^2)]

enum class BodyType : std::uint8_t {
    Static,  ///< never moves
    Kinematic,  ///< moves with the velocity it is given; nothing pushes it
    Dynamic,  ///< moved by forces and collisions
};

/// Mass, center and inertia given by hand instead of by shapes and densities.
using MassOverride = std::optional<MassProperties>;

/// What a new body is like [R2].
struct BodyDef {
    BodyType type = BodyType::Dynamic;
    Position position = {};  ///< of the body's origin             [m]
    double angle = 0;  ///< any finite; brought into [0, 2 pi)  [rad]
    Vec2 linearVelocity = {};  ///< of the center of mass            [m/s]
    real angularVelocity = 0;  ///< counter-clockwise                [rad/s]
    MassOverride mass = {};  ///< none: from the shapes. Mass > 0, inertia >= 0
    real linearDamping = 0;  ///< c of exp(-c t)                   [1/s]   >= 0
    real angularDamping = 0;  ///< likewise                         [1/s]   >= 0
    real gravityScale = 1;  ///< factor on the world's gravity    [1]
    std::optional<Vec2> gravity = {};  ///< its own, instead of the world's  [m/s^2]
    bool lockX = false;  ///< never moves along x
    bool lockY = false;  ///< never moves along y
    bool lockRotation = false;  ///< never turns
    bool enabled = true;  ///< a disabled body neither moves nor collides
    bool allowSleep = true;  ///< it may fall asleep; one that may not keeps all it touches awake
    /// False: a dynamic body sleeps as it is made. It must be at rest; in a World without sleep it is awake.
    bool awake = true;
    std::string name = {};  ///< for messages, scene files and findBody; need not be unique
    std::uint64_t userData = 0;  ///< yours
};

/// What a new shape of a body is like.
struct ShapeDef {
    Geometry geometry = Circle{};
    Vec2 offset = {};  ///< of the shape's frame in the body's   [m]
    double angle = 0;  ///< of the shape's frame in the body's   [rad]
    real density = 1;  ///< [kg/m^2]   >= 0
    Material material = {};
    Filter filter = {};
    std::uint64_t userData = 0;
};

/// A force that stays on a body until removed.
struct LastingForce {
    Vec2 force = {};  ///< [N]
    Vec2 point = {};  ///< where it acts, from the center of mass   [m]
    bool forceTurns = false;  ///< the force's direction turns with the body (a rocket)
    bool pointTurns = true;  ///< the point is fixed in the body; false: the arm keeps its direction
    real torque = 0;  ///< in addition                              [N*m]
};

/// Pose and velocity of a body, for bulk reading and writing.
struct BodyState {
    Position position = {};  ///< of the body's origin     [m]
    double angle = 0;  ///< in [0, 2 pi) on output   [rad]
    Vec2 linearVelocity = {};  ///< of the center of mass    [m/s]
    real angularVelocity = 0;  ///< [rad/s]
};

}  // namespace tamias2d::inline TAMIAS_PRECISION
